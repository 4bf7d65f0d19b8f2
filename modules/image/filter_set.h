/* SPDX-License-Identifier: MIT
 *
 * The loops of filters that work on planes of floats, once for each instruction set: the coefficients of splines, levels
 * of half the size, and elliptic footprints.
 */
#ifndef MODULES_IMAGE_FILTER_SET_H
#define MODULES_IMAGE_FILTER_SET_H

#include <stddef.h>
#include <stdint.h>

#include "filter_weights.h"

/* Rows that are filtered together, and floats of a row. */
#define CM_BUNDLE_ROWS 16
#define CM_BUNDLE_COLUMNS 128

/* Those of pictures and the weight of pixels that count. */
#define CM_SPLINE_CHANNELS 65

/* Of the recursions of splines, those that go forth come first. */
typedef enum cm_spline_way
{
    CM_SPLINE_FORTH,
    CM_SPLINE_BACK
} cm_spline_way;

/* Of a new pixel: the first of the pixels that it is made of, and their weights. */
#define CM_HALF_TAPS 12
typedef struct cm_half_taps
{
    int32_t first;
    float weight[CM_HALF_TAPS];
} cm_half_taps;

/* A kernel of elliptic footprints: u^2 times a polynomial of u, which is 1 less the square of the place, 0 at the
 * edge. */
#define CM_EWA_TERMS 6
typedef struct cm_ewa_kernel
{
    float term[CM_EWA_TERMS];
    float radius; /* of the edge, in target pixels */
} cm_ewa_kernel;

/* J J^T of pixels, in source pixels; the squares of its axes; the level by the minor one. */
#define CM_EWA_MOST 256
typedef struct cm_ewa_axes
{
    float xx[CM_EWA_MOST];
    float xy[CM_EWA_MOST];
    float yy[CM_EWA_MOST];
    float major[CM_EWA_MOST];
    float minor[CM_EWA_MOST];
    int32_t level[CM_EWA_MOST];
} cm_ewa_axes;

/* Ellipses, q = a x x + b x y + c y y from their centres, on levels that have so many pixels across and down for one of
 * the source's. */
typedef struct cm_ewa_shapes
{
    float across[CM_EWA_MOST];
    float down[CM_EWA_MOST];
    float a[CM_EWA_MOST];
    float b[CM_EWA_MOST];
    float c[CM_EWA_MOST];
    float half_width[CM_EWA_MOST];
    float half_height[CM_EWA_MOST];
} cm_ewa_shapes;

/* One of them around an origin. */
typedef struct cm_ewa_footprint
{
    float x; /* the centre */
    float y;
    float a;
    float b;
    float c;
    float half_width;
    float half_height;
    int32_t left; /* the first and the last column and row that there are */
    int32_t right;
    int32_t top;
    int32_t bottom;
} cm_ewa_footprint;

typedef struct cm_filter_set
{
    const char *name; /* as in options.h */
    /* Coefficients of quintic splines in place, along columns: `floats` of them, CM_BUNDLE_COLUMNS at most, rows `stride`
     * floats apart. */
    void (*spline_columns)(float *first, size_t floats, size_t rows, ptrdiff_t stride);
    /* A part of that, in rows: all parts forth, from the first one on, then all back, from the last one on, give the same
     * bits. is_begin: is it the first that goes this way? state, 2 * CM_BUNDLE_COLUMNS floats, goes from part to part. */
    void (*spline_columns_part)(float *first, size_t floats, size_t rows, ptrdiff_t stride,
                                cm_spline_way way, int is_begin, float *state);
    /* Coefficients along CM_BUNDLE_ROWS rows `stride` floats apart, of which rows count, each of `floats` numbers whose
     * channels are one beside the other, CM_SPLINE_CHANNELS at most. desk has room for CM_BUNDLE_ROWS * floats. */
    void (*spline_rows)(float *first, size_t rows, ptrdiff_t stride, size_t floats, size_t channels,
                        float *desk);
    /* The weighted sum of CM_HALF_TAPS rows of n floats. */
    void (*mix_rows)(const float *first, ptrdiff_t stride, const float *weight, size_t n,
                     float *to);
    /* n new pixels of a row from `length` floats of the desk, which begin CM_HALF_TAPS / 2 before its first pixel; behind
     * them the desk has as much room again, and 64 more. If is_even, n is half the row's pixels. */
    void (*halve_row)(float *desk, size_t length, const cm_half_taps *taps, int is_even, size_t n,
                      float *to);
    /* Of n pixels, CM_EWA_MOST at most, from their derivatives: the level is the last whose minor axis is at least
     * `minor` of its pixels. */
    void (*ewa_axes)(size_t n, const float *x_by_column, const float *y_by_column,
                     const float *x_by_row, const float *y_by_row, float minor, unsigned levels,
                     cm_ewa_axes *axes);
    /* From the scales that shapes have. */
    void (*ewa_shapes)(size_t n, const cm_ewa_axes *axes, const cm_ewa_kernel *kernel,
                       float pixels_most, cm_ewa_shapes *shapes);
    /* The weighted mean of the pixels of a footprint, whose origin is the pixel `first`. All its pixels are there, and
     * CM_WINDOW_SLACK bytes behind each row of them. */
    void (*ewa_sum)(const float *first, ptrdiff_t row, ptrdiff_t channel, size_t channels,
                    const cm_ewa_footprint *print, const cm_ewa_kernel *kernel, float *to);
    /* The same of those that are there. */
    void (*ewa_sum_cut)(const float *first, ptrdiff_t row, ptrdiff_t channel, size_t channels,
                        const cm_ewa_footprint *print, const cm_ewa_kernel *kernel, float *to);
    /* to = (1 - share) to + share times the value at the footprint's centre by a filter of six taps. */
    void (*ewa_sharp)(const float *first, ptrdiff_t row, ptrdiff_t channel, size_t channels,
                      const cm_ewa_footprint *print, const cm_filter_table *table, float share,
                      float *to);
} cm_filter_set;

extern const cm_filter_set cm_filter_scalar;
#ifdef CM_HAVE_SSE2
extern const cm_filter_set cm_filter_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const cm_filter_set cm_filter_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const cm_filter_set cm_filter_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const cm_filter_set cm_filter_neon;
#endif

/* The set of that name, as cm_sample_set has it. */
const cm_filter_set *cm_filter_set_find(const char *name);

#endif
