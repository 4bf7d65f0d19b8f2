/* SPDX-License-Identifier: MIT
 *
 * The weights of filters that are separable and have 4 or 6 taps, and tables of them.
 */
#ifndef CUBEMAP_IMAGE_FILTER_WEIGHTS_H
#define CUBEMAP_IMAGE_FILTER_WEIGHTS_H

#include <stdint.h>

#include <cubemap/image.h>

#define CM_FILTER_TAPS_MAX 6
#define CM_FILTER_SEGMENTS 64
#define CM_FILTER_PHASES 256
#define CM_FILTER_ONE 16384 /* the weight 1 of whole ones */

/* The weights of a filter by the position between two pixels, t from 0 to 1; rows are padded with zeros to 8 taps.
 *   segments   for arithmetic in float: with s = floor(64 t), u = 64 t - s, the weights of the taps are
 *              c0 + u c1 + u^2 c2, a parabola through the true ones at u = 0, 1/2 and 1
 *   whole      for bytes: of the nearest of 256 phases, t = 1 too; whole numbers whose sum is CM_FILTER_ONE
 *   real       the true weights of the same phases */
typedef struct cm_filter_table
{
    float segments[CM_FILTER_SEGMENTS][3][8];
    float real[CM_FILTER_PHASES + 1][8];
    int16_t whole[CM_FILTER_PHASES + 1][8];
} cm_filter_table;

/* The taps of a filter, each way: 4 or 6; 0 for one that is none of these: NEAREST, BILINEAR, EWA, AUTO. */
unsigned cm_filter_taps(cm_filter filter);

/* The weights at t from 0 to 1, of the pixels at -(taps / 2 - 1) to taps / 2; their sum is 1. Those of
 * CM_FILTER_BSPLINE5 are of its coefficients. */
void cm_filter_weights(cm_filter filter, double t, double weights[CM_FILTER_TAPS_MAX]);

/* Of a filter that has taps. */
void cm_filter_table_fill(cm_filter filter, cm_filter_table *table);

#endif
