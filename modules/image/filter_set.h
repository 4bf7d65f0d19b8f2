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
    CM_SPLINE_PASS, /* the same, which changes no number but the state */
    CM_SPLINE_BACK
} cm_spline_way;

/* Of a new pixel: the first of the pixels that it is made of, and their weights, as whole numbers of CM_HALF_ONE, too: 12
 * where levels are halves, 16 where they are three eighths. */
#define CM_HALF_TAPS 12
#define CM_EIGHTHS_TAPS 16
#define CM_TAPS_MOST CM_EIGHTHS_TAPS
#define CM_HALF_DESK 8
#define CM_HALF_BITS 14
#define CM_HALF_ONE (1 << CM_HALF_BITS)

/* Of bytes the weights are whole numbers of 64.25 times 512, so that sums are of numbers of which 16384 is 1. */
#define CM_HALF_BYTE_BITS 9
#define CM_HALF_BYTE_ONE 32896
#define CM_ROWS_NEXT 8
#define CM_EIGHTHS_ROWS (CM_EIGHTHS_TAPS + 6)
typedef struct cm_half_taps
{
    int32_t first;
    float weight[CM_TAPS_MOST];
    int16_t whole[CM_TAPS_MOST];
} cm_half_taps;

/* What new pixels of a row have in common: two of the old ones are one, and all weights the same; or eight are three, and
 * so many have the same weights again; or, of odd sizes, nothing. */
typedef enum cm_half_steps
{
    CM_HALF_ODD,
    CM_HALF_EVEN,
    CM_EIGHTHS_ODD,
    CM_EIGHTHS_EVEN
} cm_half_steps;

static inline int cm_half_count(cm_half_steps steps)
{
    return steps == CM_EIGHTHS_ODD || steps == CM_EIGHTHS_EVEN ? CM_EIGHTHS_TAPS : CM_HALF_TAPS;
}

/* A kernel of elliptic footprints: u^2 times a polynomial of u, which is 1 less the square of the place, 0 at the
 * edge. The last term is 1: whatever else kernels have in common is left to the sum of weights. */
#define CM_EWA_TERMS 4
typedef struct cm_ewa_kernel
{
    float term[CM_EWA_TERMS];
    float radius; /* of the edge, in target pixels */
} cm_ewa_kernel;

/* Pixels around the box of an ellipse that has one pixel each way or more, of which ewa_sharp reads six each way. */
#define CM_EWA_SHARP 2

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

/* A level as a group of pixels sees it. Places are from the centre of a pixel of the level. */
typedef struct cm_ewa_frame
{
    float across; /* pixels for one of the source's, of columns and rows */
    float down;
    float x; /* the group's origin */
    float y;
    int32_t left; /* the first and the last column and row that there are */
    int32_t right;
    int32_t top;
    int32_t bottom;
} cm_ewa_frame;

/* Ellipses in a frame: q = a x x + b x y + c y y from their centres, and the boxes of their pixels. */
typedef struct cm_ewa_shapes
{
    float x[CM_EWA_MOST]; /* the centre */
    float y[CM_EWA_MOST];
    float a[CM_EWA_MOST];
    float b[CM_EWA_MOST];
    float c[CM_EWA_MOST];
    int32_t left[CM_EWA_MOST];
    int32_t right[CM_EWA_MOST];
    int32_t top[CM_EWA_MOST];
    int32_t bottom[CM_EWA_MOST];
    int32_t whole[CM_EWA_MOST]; /* are all pixels there, with those that ewa_sharp needs? */
    /* where the box begins: x, and u = 1 - q = first_u - (a x + tilt) x; a row further it is less by b x + loss */
    float first_x[CM_EWA_MOST];
    float first_u[CM_EWA_MOST];
    float tilt[CM_EWA_MOST];
    float loss[CM_EWA_MOST];
} cm_ewa_shapes;

/* Pixels of a frame, each row channel by channel. Behind each row of a channel CM_WINDOW_SLACK bytes may be read. */
typedef struct cm_ewa_pixels
{
    const float *first; /* the one that places are from */
    ptrdiff_t row;
    ptrdiff_t channel;
    size_t channels;
} cm_ewa_pixels;

/* Places between six pixels each way, CM_SIX_MOST at most: of one way the first pixel of each, and weights. */
#define CM_SIX 6
#define CM_SIX_MOST 64
#define CM_SIX_CHANNELS 4
typedef struct cm_six_points
{
    int32_t first[CM_SIX_MOST];
    int32_t exact[CM_SIX_MOST];   /* is the place a pixel's centre? */
    int32_t outside[CM_SIX_MOST]; /* does it lie before the first pixel or behind the last? */
    double place[CM_SIX_MOST];    /* from the first one */
    float weight[CM_SIX][CM_SIX_MOST];
} cm_six_points;

/* Rows of nodes of polynomials along edges. */
#define CM_NODES 8

typedef struct cm_filter_set
{
    const char *name; /* as in options.h */
    /* The sums of CM_NODES rows of n numbers, by the weights of rows, with the same bits in all sets. */
    void (*sum_nodes)(const double *weight, const double *node, size_t n, double *sum);
    /* Of n positions in a row of `extent` pixels, six at least, the nearest ones and Lagrange's weights, exactly 0 and 1 at
     * pixels. is_cautious: what is outside has two points, since six would magnify what rounding has left of bytes eight
     * times. All sets have the same bits of these, and of the sums. */
    void (*six_points)(size_t n, const double *position, uint32_t extent, int is_cautious,
                       cm_six_points *at);
    /* The same of n positions in pixels that are `scale` wide, which has no places, nor whether they are outside. */
    void (*border_points)(size_t n, const double *position, double scale, uint32_t extent,
                          cm_six_points *at);
    /* The values of n places from their first pixels, whose channels, CM_SIX_CHANNELS at most, are one beside the other, as
     * bytes times a scale, or as floats; rows are so many bytes apart. CM_SIX_CHANNELS floats are written of each. Of a row
     * 24 numbers may be read. */
    void (*six_bytes)(size_t channels, size_t n, const void *const *from, ptrdiff_t row,
                      float scale, const cm_six_points *across, const cm_six_points *along,
                      float *to);
    void (*six_floats)(size_t channels, size_t n, const void *const *from, ptrdiff_t row,
                       float scale, const cm_six_points *across, const cm_six_points *along,
                       float *to);
    /* The same of whole numbers and of floats whose channels, CM_SIX_CHANNELS at most, are so many bytes apart, and
     * CM_SIX_MOST floats in `to`. Of a row eight numbers may be read. */
    void (*six_words)(size_t channels, size_t n, const void *const *from, ptrdiff_t row,
                      ptrdiff_t channel, const cm_six_points *across, const cm_six_points *along,
                      float *to);
    void (*six_lines)(size_t channels, size_t n, const void *const *from, ptrdiff_t row,
                      ptrdiff_t channel, const cm_six_points *across, const cm_six_points *along,
                      float *to);
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
    /* The weighted sum of as many rows of n floats as there are taps. */
    void (*mix_rows)(const float *const *rows, const float *weight, cm_half_steps steps, size_t n,
                     float *to);
    /* The same of halves, and of the rows two further, of which there are two more. */
    void (*mix_two_rows)(const float *const *rows, const float *weight, size_t n, float *to,
                         float *below);
    /* n pixels, whose channels are one beside the other, channel by channel, `channel` floats apart. */
    void (*part_channels)(const float *from, size_t channels, size_t n, float *to,
                          ptrdiff_t channel);
    /* The same of bytes times a scale. */
    void (*part_bytes)(const uint8_t *from, size_t channels, size_t n, float scale, float *to,
                       ptrdiff_t channel);
    /* Floats of whole numbers, of which `one` is 1, and back, rounded and clamped. */
    void (*from_whole)(size_t n, const int16_t *from, float one, float *to);
    void (*to_whole)(size_t n, const float *from, float one, int16_t *to);
    /* n new pixels of one channel from a row of `length` floats, which begins one before the taps of the first of them.
     * The desk has room for length + CM_HALF_DESK floats. */
    void (*halve_row)(const float *row, size_t length, const cm_half_taps *taps,
                      cm_half_steps steps, size_t n, float *desk, float *to);
    /* The same of whole numbers of 16 bits, of which 16384 is 1, to such: whatever is done with them has the same bits in
     * all sets. */
    void (*mix_whole)(const int16_t *const *rows, const int16_t *weight, cm_half_steps steps,
                      size_t n, int16_t *to);
    void (*mix_two_whole)(const int16_t *const *rows, const int16_t *weight, size_t n, int16_t *to,
                          int16_t *below);
    /* A row of halves of bytes; weights are the same from both ends, of which half are here. CM_ROWS_NEXT more rows are
     * those that are needed next. */
    void (*mix_bytes)(const uint8_t *const *rows, const int16_t *weight, size_t n, int16_t *to);
    /* Three rows of eighths of CM_EIGHTHS_ROWS rows of bytes, each of which begins three further; and those that are needed
     * next. */
    void (*mix_bytes_eighths)(const uint8_t *const *rows, const int16_t weight[3][CM_EIGHTHS_TAPS],
                              size_t n, int16_t *const *to);
    void (*part_whole)(const int16_t *from, size_t channels, size_t n, int16_t *to,
                       ptrdiff_t channel);
    void (*halve_row_whole)(const int16_t *row, const cm_half_taps *taps, cm_half_steps steps,
                            size_t n, int16_t *to);
    /* Such numbers of bytes, of which 255 is 1. */
    void (*whole_of_bytes)(size_t n, const uint8_t *from, int16_t *to);
    /* Of n pixels, CM_EWA_MOST at most, from their derivatives: the level is the last one for which the minor axis is long
     * enough: `least` has the squares, which grow. */
    void (*ewa_axes)(size_t n, const float *x_by_column, const float *y_by_column,
                     const float *x_by_row, const float *y_by_row, const float *least,
                     unsigned levels, cm_ewa_axes *axes);
    /* The shapes of n pixels, which lie at (x, y) from the group's origin, in source pixels. */
    void (*ewa_shapes)(size_t n, const float *x, const float *y, const cm_ewa_axes *axes,
                       const cm_ewa_kernel *kernel, float pixels_most, const cm_ewa_frame *frame,
                       cm_ewa_shapes *shapes);
    /* The weighted means of the pixels of n shapes, which are whole, into those pixels of `to`. */
    void (*ewa_sums)(size_t n, const uint8_t *which, const cm_ewa_shapes *shapes,
                     const cm_ewa_pixels *pixels, const cm_ewa_kernel *kernel, float *to);
    /* The same of one shape, of the pixels that are there. */
    void (*ewa_sum_cut)(unsigned which, const cm_ewa_shapes *shapes, const cm_ewa_pixels *pixels,
                        const cm_ewa_frame *frame, const cm_ewa_kernel *kernel, float *to);
    /* to = (1 - share) to + share times the value at the shape's centre by a filter of six taps. */
    void (*ewa_sharp)(unsigned which, const cm_ewa_shapes *shapes, const cm_ewa_pixels *pixels,
                      const cm_filter_table *table, float share, float *to);
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
