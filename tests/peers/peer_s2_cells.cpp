// SPDX-License-Identifier: MIT
//
// S2 (Google): its cells, bit by bit. With the mapping s2 in the frame s2 on a sphere the numbers of cells,
// tokens, parents and neighbours here are S2's, for random points and hard ones; at hard points on an edge of
// a cell the two may round to either side, which is counted. Areas are compared with S2Cell::ExactArea, and
// coverings of caps by how much they cover.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <set>
#include <vector>

#include <cubemap/cubemap.h>

#include <s2/s2cap.h>
#include <s2/s2cell.h>
#include <s2/s2cell_id.h>
#include <s2/s2cell_union.h>
#include <s2/s2region_coverer.h>

#include "truth/hard_points.h"
#include "truth/sphere.h"

namespace
{

int failures = 0;

void require(bool good, const char *what, cm_cell cell)
{
    if (!good && failures++ < 10)
    {
        std::fprintf(stderr, "%s: %016llx\n", what, static_cast<unsigned long long>(cell));
    }
}

struct Grid
{
    cm_grid *grid = nullptr;
    cm_cell_grid *cells = nullptr;
};

// S2's sphere, of radius 1.
Grid make_grid()
{
    cm_ellipsoid sphere = {};
    cm_grid_options options = {};
    Grid made;
    sphere.size = sizeof sphere;
    sphere.identifier = sphere.name = sphere.source = "";
    sphere.a = 1.0;
    options.size = sizeof options;
    options.mapping = "s2";
    options.frame = cm_frame_find("s2");
    options.ellipsoid = &sphere;
    if (cm_grid_create(&options, &made.grid) != CM_OK ||
        cm_cell_grid_create(made.grid, CM_CURVE_HILBERT, &made.cells) != CM_OK)
    {
        std::fprintf(stderr, "no grid\n");
        std::exit(1);
    }
    return made;
}

// S2 wants vectors that its squares neither overflow nor lose.
bool is_for_s2(const double p[3])
{
    const double most = std::fmax(std::fabs(p[0]), std::fmax(std::fabs(p[1]), std::fabs(p[2])));
    return most > 1e-100 && most < 1e100;
}

// Is a point's u or v within some ulp of an edge between leaves, or the point of one between faces?
bool is_near_edge(const Grid &g, const double p[3])
{
    double uv[2];
    cm_grid_forward(g.grid, p, uv);
    for (double w : uv)
    {
        const double scaled = w * 0x1p29;
        if (std::fabs(scaled - std::nearbyint(scaled)) <= 0x1p-20 || std::fabs(w) > 1.0 - 1e-15)
        {
            return true;
        }
    }
    return false;
}

// Points to leaves. What is not near an edge must be equal.
void compare_points(const Grid &g)
{
    uint64_t state = 101;
    size_t random_apart = 0;
    size_t hard_apart = 0;
    size_t hard = 0;
    const size_t random = 200000;
    for (size_t n = 0; n < random; n++)
    {
        double p[3];
        next_direction(&state, p);
        const cm_cell ours = cm_cell_forward(g.cells, 30, p);
        const bool equal = ours == S2CellId(S2Point(p[0], p[1], p[2])).id();
        random_apart += !equal;
        require(equal || is_near_edge(g, p), "a random point", ours);
    }
    for (uint64_t n = 0; n < HARD_DIRECTIONS; n += 7)
    {
        double p[3];
        hard_direction(n, p);
        if (!is_for_s2(p))
        {
            continue;
        }
        const cm_cell ours = cm_cell_forward(g.cells, 30, p);
        const bool equal = ours == S2CellId(S2Point(p[0], p[1], p[2])).id();
        hard++;
        hard_apart += !equal;
        require(equal || is_near_edge(g, p), "a hard point", ours);
    }
    std::printf("leaves of %zu random points: %zu differ; of %zu hard points: %zu, all on edges\n",
                random, random_apart, hard, hard_apart);
    require(random_apart <= 2, "random points", random_apart);
}

bool is_same(const std::vector<S2CellId> &theirs, const cm_cell *ours, size_t count)
{
    std::set<uint64_t> a;
    std::set<uint64_t> b(ours, ours + count);
    for (const S2CellId id : theirs)
    {
        a.insert(id.id());
    }
    return a == b && b.size() == count;
}

void compare_cell(const Grid &g, S2CellId id)
{
    const cm_cell cell = id.id();
    const int level = id.level();
    char token[CM_CELL_TOKEN_SIZE];
    cm_cell back = 0;
    int i = 0;
    int j = 0;
    cm_cell_place place;
    require(cm_cell_is_valid(cell) && cm_cell_level(cell) == level &&
                cm_cell_face(cell) == id.face(),
            "level or face", cell);
    require(cm_cell_token(cell, token, sizeof token) == CM_OK && id.ToToken() == token &&
                cm_cell_parse(token, &back, nullptr, 0) == CM_OK && back == cell,
            "token", cell);
    require(cm_cell_first_leaf(cell) == id.range_min().id() &&
                cm_cell_last_leaf(cell) == id.range_max().id(),
            "range", cell);
    require(cm_cell_advance(cell, 1) == id.next_wrap().id() &&
                cm_cell_advance(cell, -1) == id.prev_wrap().id(),
            "steps", cell);
    for (int up = 0; up <= level; up++)
    {
        require(cm_cell_parent(cell, up) == id.parent(up).id(), "parent", cell);
    }
    for (int k = 0; k < 4 && level < 30; k++)
    {
        require(cm_cell_child(cell, k) == id.child(k).id(), "child", cell);
    }
    id.ToFaceIJOrientation(&i, &j, nullptr);
    cm_cell_to_place(CM_CURVE_HILBERT, cell, &place);
    require(place.i == static_cast<uint32_t>(i) >> (30 - level) &&
                place.j == static_cast<uint32_t>(j) >> (30 - level),
            "place", cell);

    S2CellId edge[4];
    cm_cell ours[64];
    size_t count = 0;
    std::vector<S2CellId> all;
    id.GetEdgeNeighbors(edge);
    cm_cell_edge_neighbours(g.cells, cell, ours);
    for (int k = 0; k < 4; k++)
    {
        require(ours[k] == edge[k].id(), "edge neighbour", cell);
    }
    id.AppendAllNeighbors(level, &all);
    require(is_same(all, ours, static_cast<size_t>(cm_cell_neighbours(g.cells, cell, ours))),
            "neighbours", cell);
    if (level <= 27)
    {
        all.clear();
        id.AppendAllNeighbors(level + 3, &all);
        require(cm_cell_neighbours_at(g.cells, cell, level + 3, 64, ours, &count) == CM_OK &&
                    is_same(all, ours, count),
                "finer neighbours", cell);
    }
}

S2CellId some_cell(uint64_t *state, int n)
{
    const int last = (1 << 30) - 1;
    const int level = static_cast<int>(next_bits(state) % 31);
    const int i = n % 3 == 0 ? (n & 1 ? last : 0) : static_cast<int>(next_bits(state) >> 34);
    const int j = n % 9 < 4 ? (n & 2 ? last : 0) : static_cast<int>(next_bits(state) >> 34);
    return S2CellId::FromFaceIJ(n % 6, i, j).parent(level);
}

void compare_cells(const Grid &g)
{
    uint64_t state = 103;
    const int count = 100000;
    for (int n = 0; n < count; n++)
    {
        compare_cell(g, some_cell(&state, n));
    }
    std::printf("%d cells: numbers, tokens, ranges, parents, neighbours are S2's\n", count);
}

void compare_areas(const Grid &g)
{
    uint64_t state = 107;
    double worst = 0.0;
    double worst_fine = 0.0;
    double corner = 0.0;
    for (int n = 0; n < 4000; n++)
    {
        const S2CellId id = some_cell(&state, n);
        const double theirs = S2Cell(id).ExactArea();
        const double apart = std::fabs(cm_cell_area(g.cells, id.id()) / theirs - 1.0);
        double corners[4][3];
        (id.level() <= 8 ? worst : worst_fine) =
            std::fmax(id.level() <= 8 ? worst : worst_fine, apart);
        cm_cell_corners(g.cells, id.id(), corners);
        for (int k = 0; k < 4; k++)
        {
            const S2Point vertex = S2Cell(id).GetVertex(k);
            corner = std::fmax(corner, angle_between(corners[k], vertex.Data()));
        }
    }
    std::printf("corners within %.2g rad; areas within %.2g of ExactArea to level 8, %.2g below, "
                "where S2 subtracts\n",
                corner, worst, worst_fine);
    require(worst < 1e-12 && worst_fine < 1e-6 && corner < 4e-15, "areas or corners", 0);
}

void compare_coverings(const Grid &g)
{
    uint64_t state = 109;
    for (int budget = 8; budget <= 128; budget *= 4)
    {
        double covered = 0.0;
        double theirs = 0.0;
        double inside = 0.0;
        double inside_theirs = 0.0;
        for (int n = 0; n < 200; n++)
        {
            double p[3];
            cm_region *region = nullptr;
            cm_cell cells[200];
            size_t count = 0;
            cm_cover_options options = {};
            next_direction(&state, p);
            const double radius = std::pow(10.0, -3.0 + 3.0 * next_real(&state));
            const S2Point middle = S2Point(p[0], p[1], p[2]).Normalize();
            const S2Cap cap(middle, S1Angle::Radians(radius));
            S2RegionCoverer::Options how;
            how.set_max_cells(budget);
            S2RegionCoverer coverer(how);
            options.size = sizeof options;
            options.level_max = 30;
            options.cells_most = static_cast<size_t>(budget);
            cm_region_cap(p, radius, &region);
            for (int kind = 0; kind < 2; kind++)
            {
                options.kind = static_cast<cm_cover_kind>(kind);
                const cm_status status = cm_cover(g.cells, region, &options, 200, cells, &count);
                require(status == CM_OK && count <= options.cells_most, "a covering", count);
                const double scale = 1.0 / (radius * radius);
                for (size_t i = 0; i < count; i++)
                {
                    (kind == 0 ? covered : inside) +=
                        scale * S2Cell(S2CellId(cells[i])).ApproxArea();
                }
                const S2CellUnion found =
                    kind == 0 ? coverer.GetCovering(cap) : coverer.GetInteriorCovering(cap);
                for (const S2CellId id : found)
                {
                    (kind == 0 ? theirs : inside_theirs) += scale * S2Cell(id).ApproxArea();
                }
            }
            cm_region_destroy(region);
        }
        std::printf("caps, %d cells: covered %.3f of what S2 covers, inside %.3f\n", budget,
                    covered / theirs, inside / inside_theirs);
        require(covered < 1.15 * theirs && inside > 0.9 * inside_theirs, "coverings", 0);
    }
}

} // namespace

int main()
{
    const Grid g = make_grid();
    compare_points(g);
    compare_cells(g);
    compare_areas(g);
    compare_coverings(g);
    cm_cell_grid_destroy(g.cells);
    cm_grid_destroy(g.grid);
    return failures == 0 ? 0 : 1;
}
