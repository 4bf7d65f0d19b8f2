/* SPDX-License-Identifier: MIT
 *
 * calls: what a call of each function costs, one row a call, as the table of docs/measured/costs.md.
 *
 * A sample is so many calls that the clock's grain is lost in it; rows are measured in turn, again and again, so that a
 * slow moment of the machine falls on all of them.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/colormap.h>
#include <cubemap/cubemap.h>

#include "bench/harness/harness.h"

enum
{
    POINTS = 8192
};

static const double pi = 3.14159265358979323846;

/* What the calls are made with. */
static struct
{
    cm_mapping *coupled;
    cm_mapping *qsc;
    cm_latitude_conversion *series;
    cm_latitude_conversion *exact;
    cm_grid *grid;
    cm_cell_grid *cells;
    cm_region *cap;
    cm_region *polygon;
    cm_rotation rotation;
    cm_colormap *rainbow;
    double x[POINTS], y[POINTS], z[POINTS], lon[POINTS], lat[POINTS], u[POINTS], v[POINTS],
        to[POINTS];
    uint8_t face[POINTS];
    cm_cell cell[POINTS];
} made;

static volatile double sink;

/* ---- The calls. Each makes n of them, and returns something of what they gave ---- */

static size_t turn(size_t i)
{
    return i % POINTS;
}

static double direction_at(size_t i, double direction[3])
{
    direction[0] = made.x[turn(i)];
    direction[1] = made.y[turn(i)];
    direction[2] = made.z[turn(i)];
    return direction[0];
}

#define CALL(name, ...)                                                                            \
    static double name(size_t n)                                                                   \
    {                                                                                              \
        double sum = 0;                                                                            \
        for (size_t i = 0; i < n; i++)                                                             \
        {                                                                                          \
            double d[9], w[9];                                                                     \
            const size_t k = turn(i);                                                              \
            (void)k;                                                                               \
            direction_at(i, d);                                                                    \
            w[0] = made.u[k];                                                                      \
            w[1] = made.v[k];                                                                      \
            __VA_ARGS__                                                                            \
            sum += w[0] + d[0];                                                                    \
        }                                                                                          \
        return sum;                                                                                \
    }

/* n points in arrays of POINTS. */
#define ARRAY(name, result, ...)                                                                   \
    static double name(size_t n)                                                                   \
    {                                                                                              \
        double sum = 0;                                                                            \
        for (size_t left = n; left > 0;)                                                           \
        {                                                                                          \
            const size_t m = left < POINTS ? left : POINTS;                                        \
            __VA_ARGS__                                                                            \
            sum += (double)result[0];                                                              \
            left -= m;                                                                             \
        }                                                                                          \
        return sum;                                                                                \
    }

static double spare[2][POINTS];
static uint8_t spare_face[POINTS];
static double spare_matrix[6][POINTS];
static double *const spare_columns[6] = {spare_matrix[0], spare_matrix[1], spare_matrix[2],
                                         spare_matrix[3], spare_matrix[4], spare_matrix[5]};

CALL(call_forward, w[2] = cm_forward(made.coupled, d, w);)
CALL(call_inverse, cm_inverse(made.coupled, made.face[k], w, d);)
CALL(call_forward_lonlat, w[2] = cm_forward_lonlat(made.coupled, made.lon[k], made.lat[k], w);)
CALL(call_inverse_lonlat, cm_inverse_lonlat(made.coupled, made.face[k], w, d);)
ARRAY(array_forward, spare[0],
      cm_forward_array(made.coupled, m, made.x, made.y, made.z, spare_face, spare[0], spare[1]);)
ARRAY(array_inverse, spare[0],
      cm_inverse_array(made.coupled, m, made.face, made.u, made.v, spare[0], spare[1], made.to);)
ARRAY(array_forward_lonlat, spare[0],
      cm_forward_lonlat_array(made.coupled, m, made.lon, made.lat, spare_face, spare[0], spare[1]);)
ARRAY(array_inverse_lonlat, spare[0],
      cm_inverse_lonlat_array(made.coupled, m, made.face, made.u, made.v, spare[0], spare[1]);)
CALL(call_forward_jacobian, cm_forward_jacobian(made.coupled, d, w);)
ARRAY(array_forward_jacobian, spare_matrix[0],
      cm_forward_jacobian_array(made.coupled, m, made.x, made.y, made.z, spare_columns);)

static double call_distortion(size_t n)
{
    cm_distortion at = {0};
    for (size_t i = 0; i < n; i++)
    {
        double d[3];
        direction_at(i, d);
        cm_forward_distortion(made.coupled, d, &at);
    }
    return at.area;
}

static const cm_distortion_arrays all_distortion = {
    spare_matrix[0], spare_matrix[1], spare_matrix[2], spare_matrix[3], spare_matrix[4],
    spare_matrix[5], spare[0],        spare[1],        made.to};
ARRAY(array_distortion, spare_matrix[0],
      cm_forward_distortion_array(made.coupled, m, made.x, made.y, made.z, &all_distortion);)

static double statistics_of(const cm_mapping *mapping, size_t n)
{
    cm_statistics statistics = {.size = sizeof statistics};
    for (size_t i = 0; i < n; i++)
    {
        cm_distortion_statistics(mapping, CM_QUANTITY_AREA, NULL, &statistics);
    }
    return statistics.mean;
}

static double call_statistics_smooth(size_t n)
{
    return statistics_of(made.coupled, n);
}

static double call_statistics_creased(size_t n)
{
    return statistics_of(made.qsc, n);
}

static double call_create(size_t n)
{
    for (size_t i = 0; i < n; i++)
    {
        cm_mapping *mapping;
        if (cm_mapping_create("coupled", NULL, &mapping) == CM_OK)
        {
            cm_mapping_destroy(mapping);
        }
    }
    return 0;
}

static double call_advise_size(size_t n)
{
    cm_advice_size advice = {.size = sizeof advice};
    for (size_t i = 0; i < n; i++)
    {
        cm_advise_size(made.coupled, 1e-3, &advice);
    }
    return advice.coarsest;
}

CALL(call_rotate, cm_rotate(&made.rotation, d, w);)
CALL(call_latitude_series, w[0] = cm_latitude_convert(made.series, made.lat[k]);)
CALL(call_latitude_exact, w[0] = cm_latitude_convert(made.exact, made.lat[k]);)
ARRAY(array_latitude_series, spare[0],
      cm_latitude_convert_array(made.series, m, made.lat, spare[0]);)
ARRAY(array_latitude_direction, spare[0],
      cm_latitude_convert_direction_array(made.series, m, made.x, made.y, made.z, spare[0],
                                          spare[1], made.to);)
CALL(call_grid_forward, w[2] = cm_grid_forward_lonlat(made.grid, made.lon[k], made.lat[k], w);)
ARRAY(array_grid_forward, spare[0],
      cm_grid_forward_array(made.grid, m, made.x, made.y, made.z, spare_face, spare[0], spare[1]);)
ARRAY(array_grid_forward_lonlat, spare[0],
      cm_grid_forward_lonlat_array(made.grid, m, made.lon, made.lat, spare_face, spare[0],
                                   spare[1]);)
CALL(call_cell_parent, w[0] = (double)cm_cell_parent(made.cell[k], 12);)
CALL(call_cell_place, cm_cell_place place; cm_cell_to_place(CM_CURVE_HILBERT, made.cell[k], &place);
     w[0] = place.i;)
CALL(call_cell_token, char text[CM_CELL_TOKEN_SIZE]; cm_cell_token(made.cell[k], text, sizeof text);
     w[0] = text[0];)
CALL(call_cell_neighbours, cm_cell to[8];
     w[0] = cm_cell_neighbours(made.cells, cm_cell_parent(made.cell[k], 12), to);)

/* A covering of some 500 cells. */
static double covered(const cm_region *region, size_t n)
{
    enum
    {
        MOST = 4096
    };
    static cm_cell to[MOST];
    const cm_cover_options options = {
        .size = sizeof options, .level_max = 20, .cells_most = 512, .kind = CM_COVER_OUTER};
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
    {
        cm_cover(made.cells, region, &options, MOST, to, &count);
    }
    return (double)count;
}

static double call_cover_cap(size_t n)
{
    return covered(made.cap, n);
}

static double call_cover_polygon(size_t n)
{
    return covered(made.polygon, n);
}

CALL(call_colour, cm_colormap_color color;
     cm_colormap_color_at(made.rainbow, (double)k / POINTS, &color); w[0] = color.srgb[0];)
CALL(call_colour_position, w[0] = cm_colormap_position(made.rainbow, 256, k % 256);)

static void no_work(size_t begin, size_t end, void *user)
{
    (void)begin;
    (void)end;
    (void)user;
}

static double call_thread(size_t n)
{
    for (size_t i = 0; i < n; i++)
    {
        cm_run_threads(2, 128, 64, no_work, NULL);
    }
    return 0;
}

/* ---- Their list ---- */

typedef struct call
{
    const char *what;
    double (*run)(size_t n);
} call;

static const call calls[] = {
    {"`cm_mapping_create`", call_create},
    {"`cm_forward`", call_forward},
    {"`cm_forward_array`, a point", array_forward},
    {"`cm_inverse`", call_inverse},
    {"`cm_inverse_array`, a point", array_inverse},
    {"`cm_forward_lonlat`", call_forward_lonlat},
    {"`cm_forward_lonlat_array`, a point", array_forward_lonlat},
    {"`cm_inverse_lonlat`", call_inverse_lonlat},
    {"`cm_inverse_lonlat_array`, a point", array_inverse_lonlat},
    {"`cm_forward_jacobian`", call_forward_jacobian},
    {"`cm_forward_jacobian_array`, a point", array_forward_jacobian},
    {"`cm_forward_distortion`", call_distortion},
    {"`cm_forward_distortion_array`, a point", array_distortion},
    {"`cm_distortion_statistics`, `coupled`", call_statistics_smooth},
    {"`cm_distortion_statistics`, `qsc`, which has creases", call_statistics_creased},
    {"`cm_run_threads`, a second thread", call_thread},
    {"`cm_advise_size`", call_advise_size},
    {"`cm_rotate`", call_rotate},
    {"`cm_latitude_convert`, series", call_latitude_series},
    {"`cm_latitude_convert`, closed form", call_latitude_exact},
    {"`cm_latitude_convert_array`, series, a latitude", array_latitude_series},
    {"`cm_latitude_convert_direction_array`, series, a direction", array_latitude_direction},
    {"`cm_grid_forward_lonlat`", call_grid_forward},
    {"`cm_grid_forward_array`, a point", array_grid_forward},
    {"`cm_grid_forward_lonlat_array`, a point", array_grid_forward_lonlat},
    {"`cm_cell_parent`", call_cell_parent},
    {"`cm_cell_to_place`", call_cell_place},
    {"`cm_cell_token`", call_cell_token},
    {"`cm_cell_neighbours`", call_cell_neighbours},
    {"`cm_cover`, of a cap by 512 cells", call_cover_cap},
    {"`cm_cover`, of a polygon of 12 corners by 512 cells", call_cover_polygon},
    {"`cm_colormap_color_at`, `sequential-rainbow`", call_colour},
    {"`cm_colormap_position`, `sequential-rainbow`", call_colour_position},
};

enum
{
    CALLS = sizeof calls / sizeof calls[0]
};

/* ---- What they are made with ---- */

static void must(cm_status status, const char *what)
{
    if (status != CM_OK)
    {
        fprintf(harness_err(), "calls: %s: %s\n", what, cm_status_text(status));
        exit(1);
    }
}

static cm_grid *grid_of(const char *mapping, const char *ellipsoid)
{
    cm_ellipsoid shape;
    must(cm_ellipsoid_parse(ellipsoid, &shape, NULL, 0), ellipsoid);
    const cm_grid_options options = {
        .size = sizeof options, .mapping = mapping, .ellipsoid = &shape};
    cm_grid *grid = NULL;
    must(cm_grid_create(&options, &grid), mapping);
    return grid;
}

static void make_latitudes(void)
{
    const cm_ellipsoid *wgs84 = cm_ellipsoid_find("WGS84");
    const cm_latitude_options exact = {.size = sizeof exact, .exact = 1};
    must(cm_latitude_conversion_create(wgs84, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC, NULL,
                                       &made.series),
         "series");
    must(cm_latitude_conversion_create(wgs84, CM_LATITUDE_GEOGRAPHIC, CM_LATITUDE_AUTHALIC, &exact,
                                       &made.exact),
         "closed form");
}

static void make_regions(void)
{
    enum
    {
        CORNERS = 12
    };
    double lonlat[2 * CORNERS];
    for (size_t i = 0; i < CORNERS; i++)
    {
        const double angle = 2 * pi * (double)i / CORNERS;
        const double radius = i % 2 == 0 ? 0.1 : 0.06;
        lonlat[2 * i] = 0.2 + radius * cos(angle);
        lonlat[2 * i + 1] = 0.8 + radius * sin(angle);
    }
    const size_t corners = CORNERS;
    must(cm_region_cap_lonlat(0.2, 0.8, 0.1, &made.cap), "cap");
    must(cm_region_polygon(1, &corners, lonlat, &made.polygon), "polygon");
}

/* Points evenly over the sphere, in no order of faces. */
static void make_points(void)
{
    uint64_t state = 1;
    for (size_t i = 0; i < POINTS; i++)
    {
        state = state * 6364136223846793005u + 1442695040888963407u;
        const double first = (double)(state >> 11) * 0x1p-53;
        state = state * 6364136223846793005u + 1442695040888963407u;
        const double second = (double)(state >> 11) * 0x1p-53;
        made.lon[i] = pi * (2 * first - 1);
        made.lat[i] = asin(2 * second - 1);
        double direction[3];
        cm_direction_from_lonlat(made.lon[i], made.lat[i], direction);
        made.x[i] = direction[0];
        made.y[i] = direction[1];
        made.z[i] = direction[2];
    }
    cm_forward_array(made.coupled, POINTS, made.x, made.y, made.z, made.face, made.u, made.v);
    cm_cell_forward_array(made.cells, 30, POINTS, made.x, made.y, made.z, made.cell);
}

static void make_all(void)
{
    must(cm_mapping_create("coupled", NULL, &made.coupled), "coupled");
    must(cm_mapping_create("qsc", NULL, &made.qsc), "qsc");
    make_latitudes();
    made.grid = grid_of("coupled", "WGS84");
    must(cm_cell_grid_create(made.grid, CM_CURVE_HILBERT, &made.cells), "cells");
    must(cm_rotation_from_angles(17, 10, 32, &made.rotation), "rotation");
    must(cm_colormap_create("sequential-rainbow", &made.rainbow), "colours");
    make_regions();
    make_points();
}

static void destroy_all(void)
{
    cm_mapping_destroy(made.coupled);
    cm_mapping_destroy(made.qsc);
    cm_latitude_conversion_destroy(made.series);
    cm_latitude_conversion_destroy(made.exact);
    cm_cell_grid_destroy(made.cells);
    cm_grid_destroy(made.grid);
    cm_region_destroy(made.cap);
    cm_region_destroy(made.polygon);
    cm_colormap_destroy(made.rainbow);
}

/* ---- Measurement ---- */

static double seconds_of(const call *one, size_t n)
{
    const double begin = seconds();
    sink = one->run(n);
    return seconds() - begin;
}

static double time_call(void *user, size_t n)
{
    return seconds_of(user, n);
}

static void print_cost(FILE *out, double nanoseconds)
{
    static const struct
    {
        double factor;
        const char *unit;
    } units[] = {{1, "ns"}, {1e-3, "µs"}, {1e-6, "ms"}, {1e-9, "s"}};
    size_t unit = 0;
    while (unit < 3 && nanoseconds * units[unit].factor >= 1000)
    {
        unit++;
    }
    char text[CM_NUMBER_SIZE];
    cm_number_write(nanoseconds * units[unit].factor, 3, text);
    fprintf(out, " %s %s |", text, units[unit].unit);
}

static int measure(FILE *out, size_t samples)
{
    double *taken = allocate(CALLS * samples, sizeof *taken);
    size_t n[CALLS];
    for (size_t row = 0; row < CALLS; row++)
    {
        call one = calls[row];
        n[row] = calls_a_sample(time_call, &one);
    }
    for (size_t sample = 0; sample < samples; sample++)
    {
        for (size_t row = 0; row < CALLS; row++)
        {
            taken[row * samples + sample] = 1e9 * seconds_of(&calls[row], n[row]) / (double)n[row];
        }
        progress_bar((double)(sample + 1), (double)samples, "calls");
    }
    progress(NULL);
    fprintf(out, "%s, %s; %s %s; %s; %zu samples a row, in turn.\n\n", system_cpu(), system_name(),
            system_compiler(), system_flags(), cm_mapping_instructions(made.coupled), samples);
    fprintf(out, "| call | best | median |\n|---|---|---|\n");
    for (size_t row = 0; row < CALLS; row++)
    {
        const timing t = summary(taken + row * samples, samples);
        fprintf(out, "| %s |", calls[row].what);
        print_cost(out, t.best);
        print_cost(out, t.median);
        fputc('\n', out);
    }
    free(taken);
    return fflush(out) != 0 || ferror(out);
}

int main(int argc, char **argv)
{
    name_program("calls");
    size_t samples = 201;
    if (argc == 2 && strcmp(argv[1], "--quick") == 0)
    {
        samples = 3;
    }
    else if (argc > 1)
    {
        fprintf(harness_err(), "usage: calls [--quick]\n");
        return 2;
    }
    make_all();
    const int failed = measure(harness_out(), samples);
    destroy_all();
    return failed;
}
