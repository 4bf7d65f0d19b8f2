/* SPDX-License-Identifier: MIT
 *
 * HEALPix: what is around a pixel, its neighbours and its boundary, and rings. One pixel at a time, by the
 * same text as the loops.
 */
#include "healpix_object.h"

#include <string.h>

#define CM_LANES_BITS 64
#define CM_BACKEND 1
#include <cubemap/kernel/dialect.h>

#include "libcubemap/batch/lanes/scalar.inc"

#include "libcubemap/batch/lanes/words.inc"

#include "libcubemap/batch/healpix_lattice.inc"

static pixels_grid grid_of(const cm_healpix *healpix)
{
    return pixels_grid_of(healpix->nside, healpix->shift, healpix->is_power);
}

/* A place in a base pixel: column and row. */
typedef struct place
{
    int base;
    int64_t x;
    int64_t y;
} place;

static place place_of_pixel(const cm_healpix *healpix, int64_t pixel)
{
    pixels_grid g = grid_of(healpix);
    uint64_t number = (uint64_t)pixel;
    pixels_square square =
        healpix->order == CM_HEALPIX_NESTED
            ? pixels_square_of_nested(g, number)
            : pixels_square_of_lattice(g, pixels_lattice_of_row(g, pixels_row_of_ring(g, number)));
    return (place){(int)square.base, (int64_t)square.x, (int64_t)square.y};
}

static int64_t pixel_of_place(const cm_healpix *healpix, place at)
{
    pixels_grid g = grid_of(healpix);
    pixels_square square = {(uint64_t)at.base, (uint64_t)at.x, (uint64_t)at.y};
    return (int64_t)(healpix->order == CM_HEALPIX_NESTED
                         ? pixels_nested_of_square(g, square)
                         : pixels_ring_of_row(
                               g, pixels_row_of_centre(pixels_centre_of_square(g, square))));
}

/* ---- Neighbours ---- */

/* What a coordinate is after a step out of a base pixel, where a side has the numbers 0 to last. */
enum
{
    ALONG, /* the coordinate along the side that was crossed */
    FIRST,
    LAST
};

/* Base pixels are in three rows, north, equator and south, of four columns; those of the equator are half a
 * column west of the others: that of column c has c - 1 and c of the north above it. */
typedef struct way
{
    int exists;
    int row;
    int columns; /* so many to the east */
    int x;
    int y;
} way;

/* By row, and by the side of x and that of y: below 0, in the base pixel, beyond it. At a pole four base pixels
 * meet, each turned by a right angle; at eight corners there are only three. */
static const way ways[3][3][3] = {
    {{{1, 2, 0, LAST, LAST}, {1, 1, 0, LAST, ALONG}, {0, 0, 0, 0, 0}},
     {{1, 1, 1, ALONG, LAST}, {0, 0, 0, 0, 0}, {1, 0, -1, LAST, ALONG}},
     {{0, 0, 0, 0, 0}, {1, 0, 1, ALONG, LAST}, {1, 0, 2, LAST, LAST}}},
    {{{0, 0, 0, 0, 0}, {1, 2, -1, LAST, ALONG}, {1, 1, -1, LAST, FIRST}},
     {{1, 2, 0, ALONG, LAST}, {0, 0, 0, 0, 0}, {1, 0, -1, ALONG, FIRST}},
     {{1, 1, 1, FIRST, LAST}, {1, 0, 0, FIRST, ALONG}, {0, 0, 0, 0, 0}}},
    {{{1, 2, 2, FIRST, FIRST}, {1, 2, -1, ALONG, FIRST}, {0, 0, 0, 0, 0}},
     {{1, 2, 1, FIRST, ALONG}, {0, 0, 0, 0, 0}, {1, 1, 0, ALONG, FIRST}},
     {{0, 0, 0, 0, 0}, {1, 1, 1, FIRST, ALONG}, {1, 0, 0, FIRST, FIRST}}}};

/* 0, 1 or 2: below, in, beyond */
static int side_of(int64_t coordinate, int64_t last)
{
    return coordinate < 0 ? 0 : coordinate > last ? 2 : 1;
}

static int64_t coordinate_by(int rule, int64_t along, int64_t last)
{
    return rule == ALONG ? along : rule == FIRST ? 0 : last;
}

/* Where a place is that may be one step outside its base pixel. Is there one? */
static int settle(place *at, int64_t last)
{
    int side_x = side_of(at->x, last);
    int side_y = side_of(at->y, last);
    if (side_x == 1 && side_y == 1)
    {
        return 1;
    }
    const way *over = &ways[at->base / 4][side_x][side_y];
    int64_t along = side_x == 1 ? at->x : at->y;
    at->base = 4 * over->row + ((at->base + over->columns) & 3);
    at->x = coordinate_by(over->x, along, last);
    at->y = coordinate_by(over->y, along, last);
    return over->exists;
}

cm_status cm_healpix_neighbours(const cm_healpix *healpix, int64_t pixel, int64_t neighbour[8])
{
    /* south-west, west, ... south */
    static const int step_x[8] = {-1, -1, 0, 1, 1, 1, 0, -1};
    static const int step_y[8] = {0, 1, 1, 1, 0, -1, -1, -1};
    if (!cm_healpix_has(healpix, pixel))
    {
        return CM_ERROR_PIXEL;
    }
    place at = place_of_pixel(healpix, pixel);
    for (int i = 0; i < 8; i++)
    {
        place beside = {at.base, at.x + step_x[i], at.y + step_y[i]};
        int exists = settle(&beside, healpix->nside - 1);
        neighbour[i] = exists ? pixel_of_place(healpix, beside) : CM_HEALPIX_NO_PIXEL;
    }
    return CM_OK;
}

/* ---- Boundaries ---- */

enum
{
    STEPS_MAX = 1 << 20
};

/* A point of the grid that has steps lines to a pixel. */
static void store_corner(pixels_grid fine, int base, double across, double up, size_t at, double *x,
                         double *y, double *z)
{
    cm_xyz_f64 d =
        pixels_direction_of_centre(fine, pixels_centre_of_place(fine, (uint64_t)base, across, up));
    x[at] = d.x;
    y[at] = d.y;
    z[at] = d.z;
}

cm_status cm_healpix_boundary(const cm_healpix *healpix, int64_t pixel, size_t steps, double *x,
                              double *y, double *z)
{
    if (steps < 1 || steps > STEPS_MAX)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!cm_healpix_has(healpix, pixel))
    {
        return CM_ERROR_PIXEL;
    }
    place at = place_of_pixel(healpix, pixel);
    pixels_grid fine = pixels_grid_of(healpix->nside * (int64_t)steps, 0, 0);
    double side = (double)steps;
    double low_x = (double)at.x * side;
    double low_y = (double)at.y * side;
    for (size_t i = 0; i < steps; i++)
    {
        double part = (double)i;
        store_corner(fine, at.base, low_x + side - part, low_y + side, i, x, y, z);
        store_corner(fine, at.base, low_x, low_y + side - part, steps + i, x, y, z);
        store_corner(fine, at.base, low_x + part, low_y, 2 * steps + i, x, y, z);
        store_corner(fine, at.base, low_x + side, low_y + part, 3 * steps + i, x, y, z);
    }
    return CM_OK;
}

/* ---- Rings ---- */

/* The first pixel of a ring. */
static pixels_row first_of_ring(pixels_grid g, int64_t ring)
{
    int64_t nside = (int64_t)g.n;
    int64_t from_pole = ring < 4 * nside - ring ? ring : 4 * nside - ring;
    return (pixels_row){.polar = from_pole<nside, .south = ring> 2 * nside,
                        .ring = (double)ring,
                        .quarter = (double)(from_pole < nside ? from_pole : nside),
                        .index = 0.0};
}

cm_status cm_healpix_ring_info(const cm_healpix *healpix, int64_t ring, cm_healpix_ring *info)
{
    if (info == NULL || info->size != sizeof *info)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (ring < 1 || ring > cm_healpix_ring_count(healpix))
    {
        return CM_ERROR_PIXEL;
    }
    pixels_grid g = grid_of(healpix);
    pixels_row row = first_of_ring(g, ring);
    pixels_centre c = pixels_centre_of_row(g, row);
    pixels_height h = pixels_height_of_centre(g, c);
    info->ring = ring;
    info->first = (int64_t)pixels_ring_of_row(g, row);
    info->count = 4 * (int64_t)row.quarter;
    info->z = h.z;
    info->rho = h.rho;
    info->is_shifted = c.eighths > 0.0;
    return CM_OK;
}

cm_status cm_healpix_ring_from_pixel(const cm_healpix *healpix, int64_t pixel, int64_t *ring,
                                     int64_t *index)
{
    if (!cm_healpix_has(healpix, pixel))
    {
        return CM_ERROR_PIXEL;
    }
    pixels_grid g = grid_of(healpix);
    uint64_t number = (uint64_t)pixel;
    pixels_row row = pixels_row_of_ring(g, number);
    if (healpix->order == CM_HEALPIX_NESTED)
    {
        row = pixels_row_of_centre(pixels_centre_of_square(g, pixels_square_of_nested(g, number)));
    }
    *ring = (int64_t)row.ring;
    *index = (int64_t)row.index;
    return CM_OK;
}
