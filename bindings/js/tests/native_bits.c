/* SPDX-License-Identifier: MIT
 *
 * What the native library's plain C computes at hard points and others, for the tests of JavaScript: for each mapping of
 * the catalogue in each frame blocks of n numbers, in the order of write_mapping; then latitudes, cells, pixels.
 * Usage: native_bits N >FILE
 */
#include <cubemap/cubemap.h>

#include "truth/hard_points.h"

#include <stdio.h>
#include <stdlib.h>

enum
{
    MOST = 20000
};

static double x[MOST], y[MOST], z[MOST], u[MOST], v[MOST], to[6][MOST];
static float x32[MOST], y32[MOST], z32[MOST], u32[MOST], v32[MOST];
static uint8_t face[MOST];
static uint64_t cell[MOST];
static int64_t pixel[MOST];
static size_t n;

static void put(const void *values, size_t size)
{
    if (fwrite(values, size, n, stdout) != n)
    {
        exit(1);
    }
}

/* Every third is ordinary. */
static void make_directions(void)
{
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++)
    {
        double d[3];
        hard_direction(i * 7919, d);
        for (int k = 0; k < 3 && i % 3 == 0; k++)
        {
            state = state * 6364136223846793005u + 1442695040888963407u;
            d[k] = (double)(state >> 11) * 0x1p-52 - 1.0;
        }
        x[i] = d[0];
        y[i] = d[1];
        z[i] = d[2];
        x32[i] = (float)d[0];
        y32[i] = (float)d[1];
        z32[i] = (float)d[2];
    }
}

static void make_points(void)
{
    for (size_t i = 0; i < n; i++)
    {
        double uv[2];
        hard_point(i * 7919, uv);
        face[i] = (uint8_t)(i % 7);
        u[i] = uv[0];
        v[i] = uv[1];
        u32[i] = (float)uv[0];
        v32[i] = (float)uv[1];
    }
}

static void put_points(void)
{
    put(face, 1);
    put(u, sizeof *u);
    put(v, sizeof *v);
}

static void put_points_f32(void)
{
    put(face, 1);
    put(u32, sizeof *u32);
    put(v32, sizeof *v32);
}

static void put_columns(size_t count)
{
    for (size_t k = 0; k < count; k++)
    {
        put(to[k], sizeof **to);
    }
}

static void write_mapping(const char *specification, const cm_frame *frame)
{
    double *const six[6] = {to[0], to[1], to[2], to[3], to[4], to[5]};
    const cm_options options = {.size = sizeof options, .instructions = "scalar"};
    cm_mapping *mapping;
    if (cm_mapping_create_with(specification, frame, &options, &mapping) != CM_OK)
    {
        exit(1);
    }
    cm_forward_array(mapping, n, x, y, z, face, u, v);
    put_points();
    cm_forward_array_f32(mapping, n, x32, y32, z32, face, u32, v32);
    put_points_f32();
    cm_forward_jacobian_array(mapping, n, x, y, z, six);
    put_columns(6);
    make_points();
    cm_inverse_array(mapping, n, face, u, v, to[0], to[1], to[2]);
    put_columns(3);
    cm_inverse_array_f32(mapping, n, face, u32, v32, u32, v32, x32);
    put(u32, sizeof *u32);
    put(v32, sizeof *v32);
    put(x32, sizeof *x32);
    make_points();
    cm_inverse_jacobian_array(mapping, n, face, u, v, six);
    put_columns(6);
    make_directions();
    cm_mapping_destroy(mapping);
}

static void write_earth(void)
{
    cm_grid *grid;
    cm_cell_grid *cells;
    cm_healpix *healpix;
    const cm_options options = {.size = sizeof options, .instructions = "scalar"};
    const cm_grid_options grid_options = {.size = sizeof grid_options, .options = &options};
    if (cm_grid_create(&grid_options, &grid) != CM_OK ||
        cm_cell_grid_create(grid, CM_CURVE_HILBERT, &cells) != CM_OK ||
        cm_healpix_create(1 << 20, CM_HEALPIX_NESTED, &options, &healpix) != CM_OK)
    {
        exit(1);
    }
    cm_grid_forward_array(grid, n, x, y, z, face, u, v);
    put_points();
    cm_cell_forward_array(cells, 30, n, x, y, z, cell);
    put(cell, sizeof *cell);
    cm_cell_centre_array(cells, n, cell, to[0], to[1], to[2]);
    put_columns(3);
    cm_healpix_pixel_from_direction_array(healpix, n, x, y, z, pixel);
    put(pixel, sizeof *pixel);
    cm_healpix_direction_from_pixel_array(healpix, n, pixel, to[0], to[1], to[2]);
    put_columns(3);
    cm_lonlat_from_direction_array(n, x, y, z, to[0], to[1]);
    put_columns(2);
    cm_healpix_destroy(healpix);
    cm_cell_grid_destroy(cells);
    cm_grid_destroy(grid);
}

int main(int count, char **arguments)
{
    n = count == 2 ? (size_t)strtoul(arguments[1], NULL, 10) : 0;
    if (n == 0 || n > MOST)
    {
        fprintf(stderr, "usage: native_bits N, at most %d\n", MOST);
        return 2;
    }
    make_directions();
    put(x, sizeof *x);
    put(y, sizeof *y);
    put(z, sizeof *z);
    make_points();
    put_points();
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        for (size_t k = 0; k < cm_frame_count(); k++)
        {
            write_mapping(cm_catalogue_at(i)->identifier, cm_frame_at(k));
        }
    }
    write_earth();
    return ferror(stdout) != 0;
}
