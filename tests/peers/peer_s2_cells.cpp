// SPDX-License-Identifier: MIT
//
// S2 (Google): its cells, bit by bit. Numbers of cells, tokens, parents and neighbours are S2's. Of a cell grid that
// cm_cell_grid_create_s2 made, so are the cells of all points, and their centres and corners. Of another one points on
// an edge of a cell may be on the other side, which is counted. Areas are compared with S2Cell::ExactArea, and
// coverings of caps by how much they cover.
//
// With --vectors it prints tests/vectors/cells/s2.txt instead.
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
#include <s2/s2latlng.h>
#include <s2/s2region_coverer.h>

#include "tests/amount.h"
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
    cm_cell_grid *s2 = nullptr; // as S2 rounds
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
        cm_cell_grid_create(made.grid, CM_CURVE_HILBERT, &made.cells) != CM_OK ||
        cm_cell_grid_create_s2(made.grid, &made.s2) != CM_OK)
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

// ---- To the bit ----

bool same_bits(const double *ours, const double *theirs, size_t count)
{
    return std::memcmp(ours, theirs, count * sizeof *ours) == 0;
}

S2CellId random_id(uint64_t *state)
{
    const int level = static_cast<int>(next_bits(state) % 31);
    return S2CellId::FromFaceIJ(static_cast<int>(next_bits(state) % 6),
                                static_cast<int>(next_bits(state) >> 34),
                                static_cast<int>(next_bits(state) >> 34))
        .parent(level);
}

// Points, in arrays and then one of many alone.
struct List
{
    const char *name;
    std::vector<double> x, y, z;

    void add(const S2Point &p)
    {
        x.push_back(p[0]);
        y.push_back(p[1]);
        z.push_back(p[2]);
    }
};

// How many are in other leaves than S2's, or, at that level, in other cells.
size_t count_apart(const List &list, const cm_cell_grid *cells, int level)
{
    std::vector<cm_cell> ours(list.x.size());
    size_t apart = 0;
    cm_cell_forward_array(cells, level, ours.size(), list.x.data(), list.y.data(), list.z.data(),
                          ours.data());
    for (size_t i = 0; i < ours.size(); i++)
    {
        const S2Point p(list.x[i], list.y[i], list.z[i]);
        const bool none = p == S2Point(0, 0, 0);
        apart += ours[i] != (none ? CM_NO_CELL : S2CellId(p).parent(level).id());
        if (i % 7 == 0)
        {
            const double normal[3] = {p[0], p[1], p[2]};
            require(cm_cell_forward(cells, level, normal) == ours[i], "a point alone", ours[i]);
        }
    }
    return apart;
}

void compare_list(const Grid &g, const List &list)
{
    const size_t apart = count_apart(list, g.s2, 30) + count_apart(list, g.s2, 1);
    std::printf("%s: of %zu points %zu are in other cells than S2's; without its rounding %zu at "
                "level 1, %zu of the leaves\n",
                list.name, list.x.size(), apart, count_apart(list, g.cells, 1),
                count_apart(list, g.cells, 30));
    require(apart == 0, list.name, apart);
}

List random_points(size_t count)
{
    List list = {"random points", {}, {}, {}};
    uint64_t state = 113;
    for (size_t n = 0; n < count; n++)
    {
        double p[3];
        next_direction(&state, p);
        list.add(S2Point(p[0], p[1], p[2]));
    }
    return list;
}

List hard_points(uint64_t step)
{
    List list = {"hard points, subnormal ones too", {}, {}, {}};
    for (uint64_t n = 0; n < HARD_DIRECTIONS; n += step)
    {
        double p[3];
        hard_direction(n, p);
        list.add(S2Point(p[0], p[1], p[2]));
    }
    return list;
}

List whole_degrees()
{
    List list = {"whole degrees, with both ends", {}, {}, {}};
    for (int lat = -90; lat <= 90; lat++)
    {
        for (int lon = -180; lon <= 180; lon++)
        {
            list.add(S2LatLng::FromDegrees(lat, lon).ToPoint());
        }
    }
    return list;
}

List cell_centres(size_t count)
{
    List list = {"centres of S2's cells", {}, {}, {}};
    uint64_t state = 127;
    for (size_t n = 0; n < count; n++)
    {
        list.add(random_id(&state).ToPoint());
    }
    return list;
}

List cell_corners(size_t count)
{
    List list = {"corners of S2's cells", {}, {}, {}};
    uint64_t state = 131;
    for (size_t n = 0; n < count; n++)
    {
        list.add(S2Cell(random_id(&state)).GetVertex(static_cast<int>(n % 4)));
    }
    return list;
}

// On edges and corners of faces, and an ulp beside.
List edges_of_faces(size_t count)
{
    List list = {"edges of faces and beside them", {}, {}, {}};
    uint64_t state = 137;
    for (size_t n = 0; n < count; n++)
    {
        const double size =
            std::ldexp(1.5 + 0.5 * next_real(&state), static_cast<int>(n % 5) * 250 - 500);
        double p[3] = {size, size, n % 3 == 0 ? size : size * next_real(&state)};
        p[n % 3] = n % 4 == 0 ? std::nextafter(p[n % 3], 0.0) : p[n % 3];
        for (double &w : p)
        {
            w = next_bits(&state) >> 63 != 0 ? w : -w;
        }
        const size_t first = next_bits(&state) % 3;
        list.add(S2Point(p[first], p[(first + 1) % 3], p[(first + 2) % 3]));
    }
    return list;
}

void compare_lonlats(const Grid &g, size_t count)
{
    uint64_t state = 139;
    size_t apart = 0;
    for (size_t n = 0; n < 361 * 181 + count; n++)
    {
        const bool whole = n < 361 * 181;
        const double lon = whole ? static_cast<double>(n % 361) - 180.0 : 180.0 * next_real(&state);
        const double lat = whole ? static_cast<double>(n / 361) - 90.0 : 90.0 * next_real(&state);
        const S2LatLng at = S2LatLng::FromDegrees(lat, lon);
        apart += cm_cell_forward_lonlat(g.s2, 30, at.lng().radians(), at.lat().radians()) !=
                 S2CellId(at).id();
    }
    std::printf("%zu longitudes and latitudes: %zu are in other cells than S2's\n",
                361 * 181 + count, apart);
    require(apart == 0, "longitudes and latitudes", apart);
}

void compare_places(const Grid &g, size_t count)
{
    uint64_t state = 149;
    std::vector<cm_cell> cells;
    for (size_t n = 0; n < count; n++)
    {
        cells.push_back(random_id(&state).id());
    }
    std::vector<double> made[5];
    for (std::vector<double> &column : made)
    {
        column.resize(count);
    }
    cm_cell_centre_array(g.s2, count, cells.data(), made[0].data(), made[1].data(), made[2].data());
    cm_cell_centre_lonlat_array(g.s2, count, cells.data(), made[3].data(), made[4].data());
    for (size_t n = 0; n < count; n++)
    {
        const S2CellId id(cells[n]);
        const S2Point centre = id.ToPoint();
        const S2LatLng at = id.ToLatLng();
        const double theirs[5] = {centre[0], centre[1], centre[2], at.lng().radians(),
                                  at.lat().radians()};
        const double ours[5] = {made[0][n], made[1][n], made[2][n], made[3][n], made[4][n]};
        double alone[5];
        double corners[4][3];
        double lonlats[4][2];
        cm_cell_centre(g.s2, cells[n], alone);
        cm_cell_centre_lonlat(g.s2, cells[n], alone + 3);
        cm_cell_corners(g.s2, cells[n], corners);
        cm_cell_corners_lonlat(g.s2, cells[n], lonlats);
        require(same_bits(ours, theirs, 5) && same_bits(alone, theirs, 5), "a centre", cells[n]);
        for (int k = 0; k < 4; k++)
        {
            const S2Point corner = S2Cell(id).GetVertex(k);
            const S2LatLng there(corner);
            const double lonlat[2] = {there.lng().radians(), there.lat().radians()};
            require(same_bits(corners[k], corner.Data(), 3) && same_bits(lonlats[k], lonlat, 2),
                    "a corner", cells[n]);
        }
    }
    std::printf("%zu centres and their corners: bit by bit S2's\n", count);
}

void compare_to_the_bit(const Grid &g)
{
    const size_t many = is_long() ? 10000000 : is_quick() ? 10000 : 1000000;
    compare_list(g, random_points(many));
    compare_list(g, hard_points(is_long() ? 1 : is_quick() ? 101 : 7));
    compare_list(g, whole_degrees());
    compare_list(g, cell_centres(many / 5));
    compare_list(g, cell_corners(many / 5));
    compare_list(g, edges_of_faces(many / 5));
    compare_lonlats(g, many / 5);
    compare_places(g, many / 20);
}

void print_point(const S2Point &p, uint64_t id)
{
    std::printf("P %a %a %a %016llx\n", p[0], p[1], p[2], static_cast<unsigned long long>(id));
}

// A part of each list, and cells.
int print_vectors()
{
    std::printf(
        "# S2 0.10.0: the leaf of a point, and the centre and the corners of a cell, to the bit.\n"
        "# Made by peer-s2-cells --vectors.\n"
        "# P x y z leaf\n# C cell x y z, of its centre and of its corners in their order\n");
    for (const List &list : {random_points(40), hard_points(23011), cell_centres(60),
                             cell_corners(40), edges_of_faces(80)})
    {
        for (size_t i = 0; i < list.x.size(); i++)
        {
            const S2Point p(list.x[i], list.y[i], list.z[i]);
            if (p != S2Point(0, 0, 0))
            {
                print_point(p, S2CellId(p).id());
            }
        }
    }
    const List degrees = whole_degrees();
    for (size_t i = 0; i < degrees.x.size(); i++)
    {
        const int lat = static_cast<int>(i / 361) - 90;
        const int lon = static_cast<int>(i % 361) - 180;
        if (lat % 45 == 0 && lon % 45 == 0 && (std::abs(lat) < 90 || lon % 90 == 0))
        {
            const S2Point p(degrees.x[i], degrees.y[i], degrees.z[i]);
            print_point(p, S2CellId(p).id());
        }
    }
    uint64_t state = 151;
    for (int n = 0; n < 60; n++)
    {
        const S2CellId id = random_id(&state);
        const S2Point centre = id.ToPoint();
        std::printf("C %016llx %a %a %a", static_cast<unsigned long long>(id.id()), centre[0],
                    centre[1], centre[2]);
        for (int k = 0; k < 4; k++)
        {
            const S2Point corner = S2Cell(id).GetVertex(k);
            std::printf(" %a %a %a", corner[0], corner[1], corner[2]);
        }
        std::printf("\n");
    }
    return 0;
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

int main(int argc, char **argv)
{
    if (argc == 2 && std::strcmp(argv[1], "--vectors") == 0)
    {
        return print_vectors();
    }
    const Grid g = make_grid();
    compare_points(g);
    compare_to_the_bit(g);
    compare_cells(g);
    compare_areas(g);
    compare_coverings(g);
    cm_cell_grid_destroy(g.cells);
    cm_cell_grid_destroy(g.s2);
    cm_grid_destroy(g.grid);
    return failures == 0 ? 0 : 1;
}
