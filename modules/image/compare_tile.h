/* SPDX-License-Identifier: MIT
 *
 * Measures with windows: pictures are cut into tiles, which threads share out; their sums are added up in order, so
 * that threads change no bit.
 */
#ifndef IMAGE_COMPARE_TILE_H
#define IMAGE_COMPARE_TILE_H

#include "compare_pixels.h"

/* Pixels along a tile's edge, and how many it has. */
enum
{
    CM_TILE = 64,
    CM_TILE_PIXELS = CM_TILE * CM_TILE
};

typedef struct cm_compare_tile
{
    uint32_t column; /* of its first pixel */
    uint32_t row;    /* as before */
    uint32_t width;  /* CM_TILE, or what is left */
    uint32_t height; /* as before */
} cm_compare_tile;

/* The values of a tile: value + k * CM_TILE_PIXELS has the k-th of each pixel, at y * tile->width + x; NaN where NaN or
 * an infinity is in the window. work is as large as was asked for. */
typedef void (*cm_compare_measure)(const void *measure, const cm_compare_pair *pair,
                                   const cm_compare_tile *tile, double *work, double *value);

/* The whole of a measure: what a pixel has is the mean of its values. */
typedef struct cm_compare_task
{
    const cm_compare_pair *pair;
    const cm_compare_options *options;
    const cm_image *map; /* NULL for none */
    size_t values;       /* of a pixel */
    size_t work;         /* doubles */
    cm_compare_measure call;
    const void *measure;
} cm_compare_task;

/* figures may be NULL, and so may means, which has as many numbers as a pixel has values. */
cm_status cm_compare_tiles(const cm_compare_task *task, cm_map_figures *figures, double *means);

/* The sum of a filter of 2 radius + 1 weights over count places: to[i] = k[0] f[i] + sum of k[j] (f[i + j step] + sign
 * f[i - j step]). from points to the place of to[0]. */
void cm_compare_filter(size_t count, const double *from, ptrdiff_t step, size_t radius,
                       const double *k, double sign, double *to);

/* One channel of the pixels around a tile, as far as radius, rows of tile->width + 2 radius. Outside the picture is the
 * nearest pixel of it, or, if outside is 0, 0. Infinities become NaN. */
void cm_compare_load(const cm_image *image, const cm_compare_tile *tile, size_t radius,
                     uint32_t channel, int outside, double *to);

#endif
