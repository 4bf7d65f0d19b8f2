/* SPDX-License-Identifier: MIT
 *
 * The loops over the places of a block's pixels, once for each instruction set: what is between exact nodes, and how
 * far from it the truth may be.
 */
#ifndef MODULES_IMAGE_PLACE_SET_H
#define MODULES_IMAGE_PLACE_SET_H

#include <stddef.h>

/* A block has so many pixels in a row, and so many nodes. */
#define CM_BLOCK_EDGE 16
#define CM_BLOCK_NODES 4

/* The same with one more on each side. */
#define CM_WIDE_NODES (CM_BLOCK_NODES + 2)

/* What each node of a row, or of a column, counts at each pixel. */
typedef float cm_place_weights[CM_BLOCK_NODES][CM_BLOCK_EDGE];
typedef float cm_wide_weights[CM_WIDE_NODES][CM_BLOCK_EDGE];

/* One coordinate of all pixels of a block, by rows, from that of 4 x 4 nodes by rows. They do not overlap. */
typedef void cm_placer(const float *nodes, const cm_place_weights *across,
                       const cm_place_weights *along, float *to);

/* The same from 6 x 6 nodes, and the least and the greatest of what is found, which is no NaN. */
typedef void cm_wide_placer(const float *nodes, const cm_wide_weights *across,
                            const cm_wide_weights *along, float *to, float *low, float *high);

/* The same in two steps, of which blocks side by side share the first: each column of nodes at each row of pixels. */
typedef float cm_wide_columns[CM_WIDE_NODES][CM_BLOCK_EDGE];
typedef void cm_wide_column_placer(const float *nodes, const cm_wide_weights *along,
                                   cm_wide_columns *columns);
typedef void cm_wide_row_placer(const cm_wide_columns *columns, const cm_wide_weights *across,
                                float *to, float *low, float *high);

/* 4 x 4 nodes by rows, which are stride elements apart, from an origin: subtracted in double, they go on as floats. And the
 * least and the greatest of them. What is read and nodes do not overlap. */
typedef void cm_place_taker(const double *at, size_t stride, double origin, float *nodes,
                            float *low, float *high);

/* squares[i] = the square of the length of the fourth difference of (x, y) from node i on; n of them, any n. Neighbours
 * are so many elements apart: 1 along a row. squares does not overlap what is read. */
typedef void cm_place_differences(size_t n, const double *x, const double *y, size_t apart,
                                  float *squares);

/* The least and the greatest x, then those of y; n is a multiple of 16, and no place is NaN. */
typedef void cm_place_bounds(size_t n, const float *x, const float *y, float bounds[4]);

typedef struct cm_place_set
{
    const char *name; /* as in options.h */
    cm_placer *place;
    cm_wide_placer *place_wide;
    cm_wide_column_placer *place_columns;
    cm_wide_row_placer *place_rows;
    cm_place_taker *take;
    cm_place_differences *differences;
    cm_place_bounds *bounds;
} cm_place_set;

extern const cm_place_set cm_place_scalar;
#ifdef CM_HAVE_SSE2
extern const cm_place_set cm_place_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const cm_place_set cm_place_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const cm_place_set cm_place_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const cm_place_set cm_place_neon;
#endif

/* The set of that name, as cm_sample_set_find has it. */
const cm_place_set *cm_place_set_find(const char *name);

#endif
