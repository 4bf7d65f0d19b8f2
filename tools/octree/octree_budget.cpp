// SPDX-License-Identifier: MIT

#include "octree_budget.hpp"

#include "octree_map.hpp"
#include "tools/cli/program.hpp"

#include <cmath>
#include <vector>

#include <cubemap/budget.h>

namespace
{

// From the centre of a cube to its corner, in edges.
const double corner = 0.5 * std::sqrt(3.0);

// A refinement is dropped if what is left of the budget has room for it: cm_budget_limit_error drops those first that bring
// least for what they cost, which are the finest.
constexpr int most_refinements = 24;

std::vector<cm_budget_entry> refinements_from(double finest)
{
    std::vector<cm_budget_entry> entries;
    for (int i = 0; i < most_refinements; ++i)
    {
        const double edge = std::ldexp(finest, i);
        cm_budget_entry entry = {};
        entry.size = sizeof entry;
        entry.name = "half the edge";
        entry.contribution = corner * edge; // of twice the edge, less that of the edge
        entry.cost = 0.75 / (edge * edge);  // voxels more that a square of surface has
        entries.push_back(entry);
    }
    return entries;
}

// What walking over a map finds.
struct MapPieces
{
    double edge = 0;
    std::uint64_t free_voxels = 0;
    std::uint64_t free_pieces = 0;
    std::uint64_t coarse_voxels = 0; // occupied ones of level 0 that are in larger voxels
    std::uint64_t coarse_pieces = 0;
    double largest = 0;
};

int add_piece(void *user, const cm_voxel *voxel)
{
    MapPieces &pieces = *static_cast<MapPieces *>(user);
    const double across = std::round(voxel->edge / pieces.edge);
    const auto many = static_cast<std::uint64_t>(across * across * across);
    if (voxel->state == CM_VOXEL_FREE)
    {
        pieces.free_voxels += many;
        ++pieces.free_pieces;
    }
    else if (voxel->state == CM_VOXEL_OCCUPIED && many > 1)
    {
        pieces.coarse_voxels += many;
        ++pieces.coarse_pieces;
        pieces.largest = std::fmax(pieces.largest, voxel->edge);
    }
    return 0;
}

MapPieces pieces_of(const cm_octree *map)
{
    const cm_octree_options &made = *cm_octree_describe(map);
    MapPieces pieces;
    pieces.edge = made.edge;
    double least[3], greatest[3];
    for (int i = 0; i < 3; ++i)
    {
        const double half = std::ldexp(made.edge, made.levels - 1);
        least[i] = made.centre[i] - half;
        greatest[i] = made.centre[i] + half;
    }
    check_map(cm_octree_walk_box(map, least, greatest, add_piece, &pieces), "the map");
    return pieces;
}

cm_budget_entry saving(const char *name, double contribution, double cost, const char *reason)
{
    cm_budget_entry entry = {};
    entry.size = sizeof entry;
    entry.name = name;
    entry.contribution = contribution;
    entry.cost = std::fmax(cost, 0);
    entry.reason = reason;
    return entry;
}

} // namespace

double edge_within_budget(double budget, std::optional<double> finest)
{
    if (!finest)
    {
        return budget / corner;
    }
    const double left = budget - corner * *finest;
    if (!(left >= 0))
    {
        throw UsageFailure("--budget is less than " + json_number(corner * *finest) +
                           ", half the diagonal of a voxel of --edge");
    }
    std::vector<cm_budget_entry> entries = refinements_from(*finest);
    cm_budget all = {};
    all.size = sizeof all;
    all.unit = "m";
    all.count = entries.size();
    all.entry = entries.data();
    check_map(cm_budget_limit_error(&all, left), "the budget");
    double edge = *finest;
    for (const cm_budget_entry &entry : entries)
    {
        if (entry.is_kept != 0)
        {
            break;
        }
        edge *= 2;
    }
    return edge;
}

std::string budget_report(const cm_octree *map, const cm_octree_count &count, double finest,
                          std::uint64_t file_bytes)
{
    const cm_octree_options &made = *cm_octree_describe(map);
    const MapPieces pieces = pieces_of(map);
    const double bytes = static_cast<double>(count.bytes);
    const double plain = made.color != 0 ? 4 : 1; // bytes of a voxel: alpha, and a colour
    const double known =
        static_cast<double>(count.occupied) * plain + static_cast<double>(count.free);
    const double coarse = static_cast<double>(pieces.coarse_voxels - pieces.coarse_pieces);
    const double ratio = finest > 0 ? made.edge / finest : 1;
    std::vector<cm_budget_entry> entries;
    entries.push_back(saving("the map as it is", 0, bytes, "what is needed"));
    entries.back().is_required = entries.back().is_kept = 1;
    entries.push_back(saving("finer voxels", corner * made.edge, bytes * (ratio * ratio - 1),
                             "the budget has room for this error"));
    entries.push_back(
        saving("one size of voxels",
               corner * std::fmax(pieces.largest - made.edge, 0) * (made.footprint > 0 ? 1 : 0),
               coarse * plain, "voxels are no finer than pixels, or alike"));
    entries.push_back(saving("free space voxel by voxel", 0,
                             static_cast<double>(pieces.free_voxels - pieces.free_pieces),
                             "equal voxels are one"));
    entries.push_back(saving("a byte for each counter", 0,
                             known - coarse * plain -
                                 static_cast<double>(pieces.free_voxels - pieces.free_pieces) -
                                 bytes,
                             "blocks are packed"));
    entries.push_back(
        saving("all in memory", 0, count.paged > 0 ? static_cast<double>(file_bytes) : 0,
               count.paged > 0 ? "--memory; they are in the file" : "there was room for all"));
    cm_budget all = {};
    all.size = sizeof all;
    all.subject = "octree";
    all.unit = "m";
    all.cost_unit = "bytes";
    all.count = entries.size();
    all.entry = entries.data();
    check_map(cm_budget_sum(&all), "the budget");
    return budget_text(all);
}
