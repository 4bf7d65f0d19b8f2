// SPDX-License-Identifier: MIT
//
// Cells, this library's arrays beside S2's functions, on the same random points in one interleaved run on
// one core: nanoseconds a point, the least of the repetitions, and beside them how many results differ from
// S2's. With the mapping s2 in the frame s2 on a sphere all do the same, "to the bit" where cm_cell_grid_create_s2
// made the cells; then equal-area cells on WGS84, which S2 does not have.
//
// Usage: cells [POINTS [REPETITIONS]]; cells count OPERATION for callgrind (--collect-atstart=no), whose
// instructions are then those of 65536 points.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <cubemap/cubemap.h>

#include <s2/s2cell.h>
#include <s2/s2cell_id.h>
#include <s2/s2latlng.h>

#ifdef HAVE_CALLGRIND
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_TOGGLE_COLLECT
#endif

#include "truth/sphere.h"

namespace
{

struct Grid
{
    cm_grid *grid = nullptr;
    cm_cell_grid *cells = nullptr;
};

Grid make_grid(const char *mapping, const char *frame, const cm_ellipsoid *ellipsoid,
               cm_curve curve)
{
    cm_grid_options options = {};
    Grid made;
    options.size = sizeof options;
    options.mapping = mapping;
    options.frame = cm_frame_find(frame);
    options.ellipsoid = ellipsoid;
    if (cm_grid_create(&options, &made.grid) != CM_OK ||
        cm_cell_grid_create(made.grid, curve, &made.cells) != CM_OK)
    {
        std::fprintf(stderr, "cells: no grid of %s\n", mapping);
        std::exit(1);
    }
    return made;
}

struct Points
{
    std::vector<double> x, y, z, lon, lat, made[3];
    std::vector<cm_cell> cell, theirs, leaf;
};

Points make_points(size_t count)
{
    Points p;
    uint64_t state = 1;
    for (size_t i = 0; i < count; i++)
    {
        double d[3];
        double lonlat[2];
        next_direction(&state, d);
        const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        p.x.push_back(d[0] / length);
        p.y.push_back(d[1] / length);
        p.z.push_back(d[2] / length);
        cm_lonlat_from_direction(d, lonlat);
        p.lon.push_back(lonlat[0]);
        p.lat.push_back(lonlat[1]);
        p.leaf.push_back(S2CellId(S2Point(p.x[i], p.y[i], p.z[i])).id());
    }
    p.cell.resize(count);
    p.theirs.resize(count);
    for (std::vector<double> &column : p.made)
    {
        column.resize(count);
    }
    return p;
}

struct Operation
{
    const char *name;
    const char *what;
    std::function<void()> run;
    bool makes_leaves; // which are to be S2's
    double seconds;
};

void set_best(Operation *operation)
{
    const auto start = std::chrono::steady_clock::now();
    operation->run();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    operation->seconds = std::fmin(operation->seconds, taken.count());
}

size_t count_apart(const Points &p, const std::vector<cm_cell> &cells)
{
    size_t apart = 0;
    for (size_t i = 0; i < p.leaf.size(); i++)
    {
        apart += cells[i] != p.leaf[i];
    }
    return apart;
}

// 0 if the text is no number of points or repetitions.
size_t number(const char *text)
{
    double value = 0;
    return cm_number_parse(text, std::strlen(text), &value) != 0 && value >= 1 && value <= 1e8
               ? static_cast<size_t>(value)
               : 0;
}

} // namespace

int main(int argc, char **argv)
{
    const bool counts = argc == 3 && std::strcmp(argv[1], "count") == 0;
    const size_t count = counts || argc < 2 ? 65536 : number(argv[1]);
    const size_t repetitions = counts || argc < 3 ? 200 : number(argv[2]);
    if (argc > 3 || count == 0 || repetitions == 0)
    {
        std::fprintf(stderr, "usage: cells [POINTS [REPETITIONS]]\n       cells count OPERATION\n");
        return 2;
    }
    cm_ellipsoid sphere = *cm_ellipsoid_find("WGS84");
    sphere.f = 0.0;
    const Grid s2 = make_grid("s2", "s2", &sphere, CM_CURVE_HILBERT);
    Grid bits = make_grid("s2", "s2", &sphere, CM_CURVE_HILBERT);
    cm_cell_grid_destroy(bits.cells);
    if (cm_cell_grid_create_s2(bits.grid, &bits.cells) != CM_OK)
    {
        std::fprintf(stderr, "cells: no cells as S2's\n");
        return 1;
    }
    const Grid morton = make_grid("s2", "s2", &sphere, CM_CURVE_MORTON);
    const Grid earth = make_grid("slice", "geo", nullptr, CM_CURVE_HILBERT);
    const Grid coupled = make_grid("coupled", "geo", nullptr, CM_CURVE_HILBERT);
    Points p = make_points(count);
    const auto forward = [&](const Grid &g) {
        cm_cell_forward_array(g.cells, 30, count, p.x.data(), p.y.data(), p.z.data(),
                              p.cell.data());
    };
    const auto from_lonlat = [&](const Grid &g) {
        cm_cell_forward_lonlat_array(g.cells, 30, count, p.lon.data(), p.lat.data(), p.cell.data());
    };
    std::vector<Operation> operations = {
        {"s2-forward", "S2: S2CellId(S2Point)",
         [&]
         {
             for (size_t i = 0; i < count; i++)
             {
                 p.theirs[i] = S2CellId(S2Point(p.x[i], p.y[i], p.z[i])).id();
             }
         },
         false, 1e9},
        {"forward", "s2 on a sphere: cm_cell_forward_array", [&] { forward(s2); }, true, 1e9},
        {"forward-bits", "the same to the bit: cm_cell_forward_array", [&] { forward(bits); }, true,
         1e9},
        {"forward-bits-single", "to the bit: cm_cell_forward",
         [&]
         {
             for (size_t i = 0; i < count; i++)
             {
                 const double normal[3] = {p.x[i], p.y[i], p.z[i]};
                 p.cell[i] = cm_cell_forward(bits.cells, 30, normal);
             }
         },
         true, 1e9},
        {"forward-morton", "the same along Morton's curve", [&] { forward(morton); }, false, 1e9},
        {"forward-single", "s2 on a sphere: cm_cell_forward",
         [&]
         {
             for (size_t i = 0; i < count; i++)
             {
                 const double normal[3] = {p.x[i], p.y[i], p.z[i]};
                 p.cell[i] = cm_cell_forward(s2.cells, 30, normal);
             }
         },
         true, 1e9},
        {"forward-earth", "slice on WGS84, equal-area: cm_cell_forward_array",
         [&] { forward(earth); }, false, 1e9},
        {"forward-coupled", "coupled on WGS84: cm_cell_forward_array", [&] { forward(coupled); },
         false, 1e9},
        {"s2-lonlat", "S2: S2CellId(S2LatLng)",
         [&]
         {
             for (size_t i = 0; i < count; i++)
             {
                 p.theirs[i] = S2CellId(S2LatLng::FromRadians(p.lat[i], p.lon[i])).id();
             }
         },
         false, 1e9},
        {"lonlat", "s2 on a sphere: cm_cell_forward_lonlat_array", [&] { from_lonlat(s2); }, false,
         1e9},
        {"lonlat-bits", "to the bit: cm_cell_forward_lonlat_array", [&] { from_lonlat(bits); },
         false, 1e9},
        {"lonlat-earth", "slice on WGS84: cm_cell_forward_lonlat_array",
         [&] { from_lonlat(earth); }, false, 1e9},
        {"s2-centre", "S2: S2CellId::ToPoint",
         [&]
         {
             for (size_t i = 0; i < count; i++)
             {
                 const S2Point at = S2CellId(p.leaf[i]).ToPoint();
                 p.made[0][i] = at[0];
                 p.made[1][i] = at[1];
                 p.made[2][i] = at[2];
             }
         },
         false, 1e9},
        {"centre", "s2 on a sphere: cm_cell_centre_array",
         [&]
         {
             cm_cell_centre_array(s2.cells, count, p.leaf.data(), p.made[0].data(),
                                  p.made[1].data(), p.made[2].data());
         },
         false, 1e9},
        {"centre-bits", "to the bit: cm_cell_centre_array",
         [&]
         {
             cm_cell_centre_array(bits.cells, count, p.leaf.data(), p.made[0].data(),
                                  p.made[1].data(), p.made[2].data());
         },
         false, 1e9},
        {"s2-neighbours", "S2: GetEdgeNeighbors",
         [&]
         {
             for (size_t i = 0; i < count; i++)
             {
                 S2CellId to[4];
                 S2CellId(p.leaf[i]).GetEdgeNeighbors(to);
                 p.theirs[i] = to[0].id() ^ to[1].id() ^ to[2].id() ^ to[3].id();
             }
         },
         false, 1e9},
        {"neighbours", "cm_cell_edge_neighbours",
         [&]
         {
             for (size_t i = 0; i < count; i++)
             {
                 cm_cell to[4];
                 cm_cell_edge_neighbours(s2.cells, p.leaf[i], to);
                 p.cell[i] = to[0] ^ to[1] ^ to[2] ^ to[3];
             }
         },
         false, 1e9},
    };
    if (counts)
    {
        for (Operation &o : operations)
        {
            if (std::strcmp(o.name, argv[2]) == 0)
            {
                CALLGRIND_TOGGLE_COLLECT;
                o.run();
                CALLGRIND_TOGGLE_COLLECT;
                return 0;
            }
        }
        std::fprintf(stderr, "cells: no operation is called %s\n", argv[2]);
        return 2;
    }
    for (size_t k = 0; k < repetitions; k++)
    {
        for (Operation &o : operations)
        {
            set_best(&o);
        }
    }
    std::printf("%zu random points, %zu repetitions, %s\n\n| | ns a point | other than S2's "
                "|\n|---|---|---|\n",
                count, repetitions, cm_mapping_instructions(cm_grid_mapping(s2.grid)));
    for (Operation &o : operations)
    {
        o.run();
        const std::string apart =
            o.makes_leaves ? std::to_string(count_apart(p, p.cell)) : std::string();
        std::printf("| %s | %.1f | %s |\n", o.what, o.seconds / double(count) * 1e9, apart.c_str());
    }
    for (const Grid &g : {s2, bits, morton, earth, coupled})
    {
        cm_cell_grid_destroy(g.cells);
        cm_grid_destroy(g.grid);
    }
    return 0;
}
