/* SPDX-License-Identifier: MIT
 *
 * What making a grid of cells costs, and the area of a cell: the least of some repetitions, on WGS84 and on an ellipsoid as
 * flat as latitudes are exact for, for mappings that are equal-area, smooth, and not smooth. Of areas the slowest of some
 * cells of a level.
 *
 * Usage: cell-costs
 */
#include "bench/harness/harness.h"

#include <cubemap/cubemap.h>

#include <math.h>
#include <stdio.h>

static const char *const mappings[] = {"slice",     "s2",         "coupled",
                                       "conformal", "difference", "smoothstep"};
static const char *const ellipsoids[] = {"WGS84", "6378137,1.25"};

/* Seconds of a call, the least of some repetitions, each of as many calls as take 2 milliseconds. */
static double time_of(void (*call)(const void *subject, cm_cell cell), const void *subject,
                      cm_cell cell)
{
    double best = (double)INFINITY;
    for (int r = 0; r < 2; r++)
    {
        double calls = 0.0;
        double taken = 0.0;
        double start = processor_seconds();
        while (taken < 2e-3)
        {
            call(subject, cell);
            calls += 1.0;
            taken = processor_seconds() - start;
        }
        best = fmin(best, taken / calls);
    }
    return best;
}

static void create(const void *grid, cm_cell unused)
{
    cm_cell_grid *cells = NULL;
    (void)unused;
    if (cm_cell_grid_create(grid, CM_CURVE_HILBERT, &cells) == CM_OK)
    {
        cm_cell_grid_destroy(cells);
    }
}

static void find_area(const void *cells, cm_cell cell)
{
    volatile double area = cm_cell_area(cells, cell);
    (void)area;
}

/* The slowest of some cells of a level. */
static double slowest_area(const cm_cell_grid *cells, int level)
{
    uint64_t count = 6ull << (2 * level);
    double most = 0.0;
    for (uint64_t k = 0; k < 6; k++)
    {
        most = fmax(most, time_of(find_area, cells, cm_cell_at_index(level, 7919 * k % count)));
    }
    return most;
}

static void measure(const char *mapping, const char *name)
{
    cm_ellipsoid ellipsoid;
    cm_grid *grid = NULL;
    cm_cell_grid *cells = NULL;
    const cm_grid_options options = {
        .size = sizeof options, .mapping = mapping, .ellipsoid = &ellipsoid};
    if (cm_ellipsoid_parse(name, &ellipsoid, NULL, 0) != CM_OK ||
        cm_grid_create(&options, &grid) != CM_OK ||
        cm_cell_grid_create(grid, CM_CURVE_HILBERT, &cells) != CM_OK)
    {
        fprintf(stderr, "cell-costs: no grid of %s\n", mapping);
        cm_grid_destroy(grid);
        return;
    }
    printf("| `%s` | %s | %.2f ms | %.3g ms | %.3g us | %.3g us |\n", mapping, name,
           1e3 * time_of(create, grid, CM_NO_CELL), 1e3 * slowest_area(cells, 0),
           1e6 * slowest_area(cells, 2), 1e6 * slowest_area(cells, 12));
    (void)fflush(stdout);
    cm_cell_grid_destroy(cells);
    cm_grid_destroy(grid);
}

int main(int argc, char **argv)
{
    name_program("cell-costs");
    if (argc > 1)
    {
        fprintf(stderr, "cell-costs: %s; usage: cell-costs\n", argv[1]);
        return 2;
    }
    printf("| mapping | ellipsoid | cm_cell_grid_create | area, level 0 | level 2 | level 12 "
           "|\n|---|---|---|---|---|---|\n");
    for (size_t e = 0; e < sizeof ellipsoids / sizeof *ellipsoids; e++)
    {
        for (size_t m = 0; m < sizeof mappings / sizeof *mappings; m++)
        {
            measure(mappings[m], ellipsoids[e]);
        }
    }
    return 0;
}
