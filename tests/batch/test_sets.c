/* SPDX-License-Identifier: MIT
 *
 * Each instruction set against the scalar one, in what has nothing to do with a mapping: longitudes and
 * latitudes, auxiliary latitudes, HEALPix's pixels and cells. At hard points and random ones, in arrays whose
 * lengths are no multiples of vectors. Needs nothing but the library, so that an emulator can run it.
 *
 * Usage: sets [POINTS], so many of each kind (default: 20000).
 */
#include <cubemap/cubemap.h>

#include "truth/hard_points.h"
#include "truth/sphere.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EPS 0x1p-53

enum
{
    LENGTH = 1021 /* of an array */
};

static int failures;
static const char *set_name;

static void complain(const char *what, size_t i, double got, double expected)
{
    if (failures++ < 20)
    {
        printf("not ok: %s, %s, point %zu: %.17g, scalar %.17g\n", set_name, what, i, got,
               expected);
    }
}

/* within so many eps of its size, or of what it is beside 1 */
static void compare(const char *what, const double *got, const double *expected, double relative,
                    double absolute)
{
    for (size_t i = 0; i < LENGTH; i++)
    {
        double bound = EPS * (relative * fabs(expected[i]) + absolute) + 0x1p-1073;
        if (!(fabs(got[i] - expected[i]) <= bound || (isnan(got[i]) && isnan(expected[i]))))
        {
            complain(what, i, got[i], expected[i]);
        }
    }
}

typedef struct inputs
{
    double x[LENGTH];
    double y[LENGTH];
    double z[LENGTH];
    double lon[LENGTH];
    double lat[LENGTH];
} inputs;

static void make_inputs(inputs *in, uint64_t *state)
{
    for (size_t i = 0; i < LENGTH; i++)
    {
        double d[3];
        double lonlat[2];
        if (i % 2 == 0)
        {
            next_direction(state, d);
        }
        else
        {
            hard_direction(next_bits(state), d);
        }
        if (i % 101 == 100)
        {
            d[i % 3] = i % 2 ? (double)NAN : (double)INFINITY;
        }
        cm_lonlat_from_direction(d, lonlat);
        in->x[i] = d[0];
        in->y[i] = d[1];
        in->z[i] = d[2];
        in->lon[i] = lonlat[0] + 6.283185307179586 * (double)(i % 7);
        in->lat[i] = lonlat[1];
    }
}

static cm_options with(const char *instructions)
{
    cm_options options = {.size = sizeof options, .instructions = instructions};
    return options;
}

static void need(cm_status status)
{
    if (status != CM_OK)
    {
        printf("not ok: %s: %s\n", set_name, cm_status_text(status));
        exit(1);
    }
}

/* ---- Longitude and latitude, by way of a mapping without a warp ---- */

static void check_lonlat(const inputs *in, const char *set)
{
    static double u[2][LENGTH], v[2][LENGTH], lon[2][LENGTH], lat[2][LENGTH];
    static uint8_t face[2][LENGTH];
    for (int k = 0; k < 2; k++)
    {
        cm_mapping *mapping = NULL;
        cm_options options = with(k == 0 ? "scalar" : set);
        need(cm_mapping_create_with("gnomonic", NULL, &options, &mapping));
        cm_forward_lonlat_array(mapping, LENGTH, in->lon, in->lat, face[k], u[k], v[k]);
        /* the same places for both */
        cm_inverse_lonlat_array(mapping, LENGTH, face[0], u[0], v[0], lon[k], lat[k]);
        cm_mapping_destroy(mapping);
    }
    for (size_t i = 0; i < LENGTH; i++)
    {
        if (face[0][i] != face[1][i])
        {
            /* only rounding on an edge decides */
            if (fmax(fabs(u[0][i]), fabs(v[0][i])) < 1.0 - 16.0 * EPS)
            {
                complain("face", i, face[1][i], face[0][i]);
            }
            u[1][i] = u[0][i];
            v[1][i] = v[0][i];
        }
    }
    compare("u", u[1], u[0], 0.0, 16.0);
    compare("v", v[1], v[0], 0.0, 16.0);
    compare("lon", lon[1], lon[0], 6.0, 0.0);
    compare("lat", lat[1], lat[0], 6.0, 0.0);
}

/* ---- Auxiliary latitudes ---- */

static void check_conversion(const inputs *in, const char *set, const cm_ellipsoid *ellipsoid,
                             cm_latitude from, cm_latitude to)
{
    static double angle[2][LENGTH], x[2][LENGTH], y[2][LENGTH], z[2][LENGTH];
    for (int k = 0; k < 2; k++)
    {
        cm_latitude_conversion *conversion = NULL;
        cm_latitude_options options = {.size = sizeof options,
                                       .instructions = k == 0 ? "scalar" : set};
        need(cm_latitude_conversion_create(ellipsoid, from, to, &options, &conversion));
        cm_latitude_convert_array(conversion, LENGTH, in->lat, angle[k]);
        cm_latitude_convert_direction_array(conversion, LENGTH, in->x, in->y, in->z, x[k], y[k],
                                            z[k]);
        cm_latitude_conversion_destroy(conversion);
    }
    compare("latitude", angle[1], angle[0], 9.0, 0.0);
    compare("x", x[1], x[0], 12.0, 0.0);
    compare("y", y[1], y[0], 12.0, 0.0);
    compare("z", z[1], z[0], 12.0, 0.0);
}

static void check_latitudes(const inputs *in, const char *set)
{
    static const char *const on[] = {"WGS84", "6378137,50", "Saturn", "6371007.2,0"};
    for (size_t e = 0; e < sizeof on / sizeof *on; e++)
    {
        cm_ellipsoid ellipsoid;
        need(cm_ellipsoid_parse(on[e], &ellipsoid, NULL, 0));
        for (int k = 0; k < CM_LATITUDE_COUNT * CM_LATITUDE_COUNT; k++)
        {
            check_conversion(in, set, &ellipsoid, (cm_latitude)(k / CM_LATITUDE_COUNT),
                             (cm_latitude)(k % CM_LATITUDE_COUNT));
        }
    }
}

/* ---- Pixels ---- */

/* Points may be on the border of two; of 2^29 pixels are 1 mm wide, and that is where the rounding of a point is
 * seen. Numbers that go from one order to the other are whole. */
static void check_pixels(const inputs *in, const char *set, int64_t nside, cm_healpix_order order)
{
    static int64_t pixel[2][LENGTH], angle_pixel[2][LENGTH], other[2][LENGTH];
    static double x[2][LENGTH], y[2][LENGTH], z[2][LENGTH], lon[2][LENGTH], lat[2][LENGTH];
    int power = (nside & (nside - 1)) == 0;
    for (int k = 0; k < 2; k++)
    {
        cm_healpix *healpix = NULL;
        cm_options options = with(k == 0 ? "scalar" : set);
        need(cm_healpix_create(nside, order, &options, &healpix));
        cm_healpix_pixel_from_direction_array(healpix, LENGTH, in->x, in->y, in->z, pixel[k]);
        cm_healpix_pixel_from_lonlat_array(healpix, LENGTH, in->lon, in->lat, angle_pixel[k]);
        cm_healpix_direction_from_pixel_array(healpix, LENGTH, pixel[0], x[k], y[k], z[k]);
        cm_healpix_lonlat_from_pixel_array(healpix, LENGTH, pixel[0], lon[k], lat[k]);
        if (power)
        {
            need((order == CM_HEALPIX_RING
                      ? cm_healpix_nested_from_ring_array
                      : cm_healpix_ring_from_nested_array)(healpix, LENGTH, pixel[0], other[k]));
        }
        cm_healpix_destroy(healpix);
    }
    compare("x of a pixel", x[1], x[0], 0.0, 8.0);
    compare("y of a pixel", y[1], y[0], 0.0, 8.0);
    compare("z of a pixel", z[1], z[0], 0.0, 8.0);
    compare("lon of a pixel", lon[1], lon[0], 0.0, 16.0);
    compare("lat of a pixel", lat[1], lat[0], 0.0, 8.0);
    size_t apart = 0;
    for (size_t i = 0; i < LENGTH; i++)
    {
        apart += (size_t)(pixel[0][i] != pixel[1][i]) + (angle_pixel[0][i] != angle_pixel[1][i]);
        if (power && other[0][i] != other[1][i])
        {
            complain("order", i, (double)other[1][i], (double)other[0][i]);
        }
        if ((pixel[0][i] < 0) != (pixel[1][i] < 0))
        {
            complain("no pixel", i, (double)pixel[1][i], (double)pixel[0][i]);
        }
    }
    /* half of the points are hard ones, which like borders */
    if (apart > LENGTH / 10)
    {
        complain("pixels that are others", apart, 0.0, 0.0);
    }
}

/* ---- Cells ---- */

static void check_cells(const inputs *in, const char *set, cm_curve curve, int level)
{
    static cm_cell cell[2][LENGTH];
    static double x[2][LENGTH], y[2][LENGTH], z[2][LENGTH];
    for (int k = 0; k < 2; k++)
    {
        cm_grid *grid = NULL;
        cm_cell_grid *cells = NULL;
        cm_options options = with(k == 0 ? "scalar" : set);
        cm_grid_options how = {.size = sizeof how, .mapping = "coupled", .options = &options};
        need(cm_grid_create(&how, &grid));
        need(cm_cell_grid_create(grid, curve, &cells));
        cm_cell_forward_array(cells, level, LENGTH, in->x, in->y, in->z, cell[k]);
        cm_cell_centre_array(cells, LENGTH, cell[0], x[k], y[k], z[k]);
        cm_cell_grid_destroy(cells);
        cm_grid_destroy(grid);
    }
    compare("x of a cell", x[1], x[0], 0.0, 12.0);
    compare("y of a cell", y[1], y[0], 0.0, 12.0);
    compare("z of a cell", z[1], z[0], 0.0, 12.0);
    size_t apart = 0;
    for (size_t i = 0; i < LENGTH; i++)
    {
        apart += cell[0][i] != cell[1][i];
        if ((cell[0][i] == CM_NO_CELL) != (cell[1][i] == CM_NO_CELL))
        {
            complain("no cell", i, (double)cell[1][i], (double)cell[0][i]);
        }
    }
    if (apart > LENGTH / 10)
    {
        complain("cells that are others", apart, 0.0, 0.0);
    }
}

/* As S2 rounds: the same bits in every set. */
static void check_s2_cells(const inputs *in, const char *set, int level)
{
    static cm_cell cell[2][LENGTH];
    static double x[2][LENGTH], y[2][LENGTH], z[2][LENGTH];
    const cm_latitude geographic = CM_LATITUDE_GEOGRAPHIC;
    for (int k = 0; k < 2; k++)
    {
        cm_grid *grid = NULL;
        cm_cell_grid *cells = NULL;
        cm_options options = with(k == 0 ? "scalar" : set);
        cm_grid_options how = {.size = sizeof how,
                               .mapping = "s2",
                               .frame = cm_frame_find("s2"),
                               .latitude = &geographic,
                               .options = &options};
        need(cm_grid_create(&how, &grid));
        need(cm_cell_grid_create_s2(grid, &cells));
        cm_cell_forward_array(cells, level, LENGTH, in->x, in->y, in->z, cell[k]);
        cm_cell_centre_array(cells, LENGTH, cell[0], x[k], y[k], z[k]);
        cm_cell_grid_destroy(cells);
        cm_grid_destroy(grid);
    }
    if (memcmp(cell[0], cell[1], sizeof cell[0]) != 0)
    {
        complain("S2's cells that are others", 0, 0.0, 0.0);
    }
    compare("x of S2's cell", x[1], x[0], 0.0, 0.0);
    compare("y of S2's cell", y[1], y[0], 0.0, 0.0);
    compare("z of S2's cell", z[1], z[0], 0.0, 0.0);
}

int main(int argc, char **argv)
{
    long points = argc > 1 ? strtol(argv[1], NULL, 10) : 20000;
    static inputs in;
    uint64_t state = 2026;
    for (long done = 0; done < points; done += LENGTH)
    {
        make_inputs(&in, &state);
        for (size_t i = 1; i < cm_instructions_count(); i++)
        {
            set_name = cm_instructions_at(i);
            check_lonlat(&in, set_name);
            check_latitudes(&in, set_name);
            check_pixels(&in, set_name, 1, CM_HEALPIX_NESTED);
            check_pixels(&in, set_name, 77, CM_HEALPIX_RING);
            check_pixels(&in, set_name, 8192, CM_HEALPIX_RING);
            check_pixels(&in, set_name, CM_HEALPIX_NSIDE_MAX, CM_HEALPIX_RING);
            check_pixels(&in, set_name, CM_HEALPIX_NSIDE_MAX, CM_HEALPIX_NESTED);
            check_cells(&in, set_name, CM_CURVE_HILBERT, 30);
            check_cells(&in, set_name, CM_CURVE_MORTON, 30);
            check_cells(&in, set_name, CM_CURVE_HILBERT, 3);
            check_s2_cells(&in, set_name, 30);
        }
    }
    printf("%zu sets compared with scalar, %d failures\n", cm_instructions_count() - 1, failures);
    return failures != 0;
}
