/* SPDX-License-Identifier: MIT
 *
 * HEALPix: what is around a pixel, its neighbours and its boundary, and rings. One pixel at a time, by the
 * same text as the loops.
 */
#include "healpix_object.h"
#include "libcubemap/batch/healpix_rings.h"

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

/* Any pixel, by its place. */
static void neighbours_of_place(const cm_healpix *healpix, int64_t pixel, int64_t neighbour[8])
{
    /* south-west, west, ... south */
    static const int step_x[8] = {-1, -1, 0, 1, 1, 1, 0, -1};
    static const int step_y[8] = {0, 1, 1, 1, 0, -1, -1, -1};
    place at = place_of_pixel(healpix, pixel);
    for (int i = 0; i < 8; i++)
    {
        place beside = {at.base, at.x + step_x[i], at.y + step_y[i]};
        int exists = settle(&beside, healpix->nside - 1);
        neighbour[i] = exists ? pixel_of_place(healpix, beside) : CM_HEALPIX_NO_PIXEL;
    }
}

/* In NESTED: of a pixel whose neighbours are all in its base pixel, by sums of the bits of x and y where they stand.
 * 1; 0 for others. */
static int neighbours_in_base(const cm_healpix *healpix, int64_t pixel, int64_t neighbour[8])
{
    uint64_t number = (uint64_t)pixel;
    uint64_t inside = ((uint64_t)1 << (2 * healpix->shift)) - 1;
    uint64_t all_x = inside & 0x5555555555555555u;
    uint64_t all_y = inside & 0xaaaaaaaaaaaaaaaau;
    uint64_t x = number & all_x;
    uint64_t y = number & all_y;
    if (x == 0 || x == all_x || y == 0 || y == all_y)
    {
        return 0;
    }
    uint64_t base = number & ~inside;
    uint64_t x_low = base | ((x - 1) & all_x);
    uint64_t x_high = base | ((x - all_x) & all_x);
    uint64_t y_low = (y - 1) & all_y;
    uint64_t y_high = (y - all_y) & all_y;
    x |= base;
    neighbour[0] = (int64_t)(x_low | y);
    neighbour[1] = (int64_t)(x_low | y_high);
    neighbour[2] = (int64_t)(x | y_high);
    neighbour[3] = (int64_t)(x_high | y_high);
    neighbour[4] = (int64_t)(x_high | y);
    neighbour[5] = (int64_t)(x_high | y_low);
    neighbour[6] = (int64_t)(x | y_low);
    neighbour[7] = (int64_t)(x_low | y_low);
    return 1;
}

/* In RING, of a pixel of the northern cap whose neighbours are in its base pixel and in the cap, or on the first ring
 * of the belt: the k-th of a quarter is beside the k-1-th and the k-th of the ring above. turn: 4 for a pixel of the
 * southern cap that is numbered backwards from last. */
static int neighbours_in_cap(int64_t nside, int64_t number, int turn, int64_t last,
                             int64_t neighbour[8])
{
    int64_t i = cm_ring_in_cap(number);
    int64_t index = number - cm_pixels_before_ring(i);
    int64_t quarter = (int64_t)(index >= i) + (index >= 2 * i) + (index >= 3 * i);
    int64_t k = index - quarter * i;
    if (k < 1 || k > i - 2 || i + 2 > nside)
    {
        return 0;
    }
    /* a ring more has 4 i pixels more before it, and one more in each quarter */
    int64_t above = number - 4 * (i - 1) - quarter;
    int64_t below = number + 4 * i + quarter;
    int64_t found[8];
    found[0] = below;
    found[1] = number - 1;
    found[2] = above - 1;
    found[3] = above - 4 * (i - 2) - quarter - 1;
    found[4] = above;
    found[5] = number + 1;
    found[6] = below + 1;
    found[7] = below + 4 * (i + 1) + quarter + 1;
    for (int j = 0; j < 8; j++)
    {
        neighbour[j ^ turn] = turn ? last - found[j] : found[j];
    }
    return 1;
}

/* In RING, of a pixel of the belt with two rings of the belt on either side. Rings are shifted by half a pixel in
 * turn, the first one towards the east. */
static int neighbours_on_belt(const cm_healpix *healpix, int64_t pixel, int64_t neighbour[8])
{
    int64_t nside = healpix->nside;
    int64_t count = 4 * nside;
    int64_t left = pixel - cm_pixels_before_ring(nside);
    int64_t after = healpix->is_power ? left >> (healpix->shift + 2) : left / count;
    if (after < 2 || after > 2 * nside - 2)
    {
        return 0;
    }
    int64_t index = left - after * count;
    int64_t west = index == 0 ? pixel + count - 1 : pixel - 1;
    int64_t east = index == count - 1 ? pixel - count + 1 : pixel + 1;
    int is_shifted = (after & 1) == 0;
    int64_t half_west = is_shifted ? pixel : west;
    int64_t half_east = is_shifted ? east : pixel;
    neighbour[0] = half_west + count;
    neighbour[1] = west;
    neighbour[2] = half_west - count;
    neighbour[3] = pixel - 2 * count;
    neighbour[4] = half_east - count;
    neighbour[5] = east;
    neighbour[6] = half_east + count;
    neighbour[7] = pixel + 2 * count;
    return 1;
}

/* In RING, of most pixels: those beside a border of base pixels in a cap, and of four rings, are left to the others. */
static int neighbours_in_rings(const cm_healpix *healpix, int64_t pixel, int64_t neighbour[8])
{
    int64_t nside = healpix->nside;
    int64_t cap = cm_pixels_before_ring(nside);
    int64_t last = healpix->count - 1;
    return pixel < cap          ? neighbours_in_cap(nside, pixel, 0, last, neighbour)
           : last - pixel < cap ? neighbours_in_cap(nside, last - pixel, 4, last, neighbour)
                                : neighbours_on_belt(healpix, pixel, neighbour);
}

cm_status cm_healpix_neighbours(const cm_healpix *healpix, int64_t pixel, int64_t neighbour[8])
{
    if (!cm_healpix_has(healpix, pixel))
    {
        return CM_ERROR_PIXEL;
    }
    int is_done = healpix->order == CM_HEALPIX_NESTED
                      ? neighbours_in_base(healpix, pixel, neighbour)
                      : neighbours_in_rings(healpix, pixel, neighbour);
    if (!is_done)
    {
        neighbours_of_place(healpix, pixel, neighbour);
    }
    return CM_OK;
}

/* ---- Boundaries ---- */

enum
{
    STEPS_MAX = 1 << 20
};

/* A point of each side, of the grid that has steps lines to a pixel; those of one side are so many after each other. */
static void store_corners(pixels_grid fine, int base, const double across[4], const double up[4],
                          size_t steps, double *x, double *y, double *z)
{
    cm_xyz_f64 d[4];
    for (int k = 0; k < 4; k++)
    {
        d[k] = pixels_direction_of_centre(
            fine, pixels_centre_of_place(fine, (uint64_t)base, across[k], up[k]));
    }
    for (size_t k = 0; k < 4; k++)
    {
        x[k * steps] = d[k].x;
        y[k * steps] = d[k].y;
        z[k * steps] = d[k].z;
    }
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
        const double across[4] = {low_x + side - part, low_x, low_x + part, low_x + side};
        const double up[4] = {low_y + side, low_y + side - part, low_y, low_y + part};
        store_corners(fine, at.base, across, up, steps, x + i, y + i, z + i);
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
