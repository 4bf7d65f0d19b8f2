/* SPDX-License-Identifier: MIT
 *
 * The loops over pixels, once for each instruction set: values between pixels, and conversions of types.
 */
#ifndef CUBEMAP_IMAGE_SAMPLE_SET_H
#define CUBEMAP_IMAGE_SAMPLE_SET_H

#include <stddef.h>
#include <stdint.h>

#include "filter_weights.h"

/* No call has more positions. */
#define CM_SAMPLES_MAX 256

/* Bytes beyond the last pixel of any row of a window that loops may read, and do not use. */
#define CM_WINDOW_SLACK 64

/* A piece of a picture. Its pixels are dense in a row; data points to the pixel (0, 0). */
typedef struct cm_window
{
    const void *data;
    ptrdiff_t row_stride; /* in bytes, may be negative */
    uint32_t channels;    /* 1 or more */
} cm_window;

/* The values at n positions, n a multiple of 16 and CM_SAMPLES_MAX at most, to n dense pixels of the window's type.
 * The centre of the window's pixel (i, j) is at x = i, y = j, so the taps are from floor(x) - (taps / 2 - 1) to
 * floor(x) + taps / 2, and of nearest floor(x + 1/2). They lie inside the window and less than 2^31 bytes from data.
 * CM_WINDOW_SLACK bytes beyond each row may be read. A pixel is the same wherever in the arrays it is; `to` and the
 * window do not overlap. Whole numbers are rounded to nearest and clamped. table is of the filter, for 4 and 6 taps
 * alone. */
typedef void cm_sampler(const cm_window *window, size_t n, const float *x, const float *y,
                        const cm_filter_table *table, void *to);

/* Positions as offsets in bytes from data, and fractions in 15 bits, of y in the upper half. */
typedef struct cm_fixed_places
{
    int32_t offset[CM_SAMPLES_MAX];
    uint32_t xy[CM_SAMPLES_MAX];
} cm_fixed_places;

/* The same in two steps, between which what is needed can be asked for: the positions' places, and then pixels by sixteen,
 * which are dense, and `down` bytes apart. For 3 and 4 channels. */
typedef void cm_places_finder(const cm_window *window, size_t n, const float *x, const float *y,
                              cm_fixed_places *at);
typedef void cm_apart_sampler(const cm_window *window, size_t n, const cm_fixed_places *at,
                              void *to, ptrdiff_t down);

/* n numbers, any n, to others: to = from * scale. from and to do not overlap. Whole numbers are rounded to nearest,
 * ties to even, and clamped; NaN is 0. Half precision is rounded likewise, overflows to infinity and keeps NaN. */
typedef void cm_converter(size_t n, const void *from, float scale, void *to);

/* sum[i] = the sum of weight[j] * row[j][i] for n numbers, one row after the other, in bits of which all sets agree. Four
 * are read and written of less than four. Nothing overlaps. */
typedef void cm_row_summer(size_t rows, const float *weight, const unsigned char *const *row,
                           size_t n, float *sum);

typedef struct cm_sample_set
{
    const char *name; /* as in options.h */
    cm_sampler *nearest_u8;
    cm_sampler *nearest_u16; /* half too */
    cm_sampler *nearest_float;
    cm_sampler *bilinear_u8;
    cm_places_finder *places_u8; /* NULL if the set has no bilinear_u8_apart */
    cm_apart_sampler *bilinear_u8_apart;
    cm_sampler *bilinear_u16;
    cm_sampler *bilinear_float;
    cm_sampler *taps4_u8;
    cm_sampler *taps4_float;
    cm_sampler *taps6_u8;
    cm_sampler *taps6_float;
    cm_converter *u8_to_float;
    cm_converter *u16_to_float;
    cm_converter *half_to_float;
    cm_converter *float_to_u8;
    cm_converter *float_to_u16;
    cm_converter *float_to_half;
    cm_row_summer *sum_u8;
    cm_row_summer *sum_scaled_u8; /* of floats that bytes are, of which 255 is 1 */
    cm_row_summer *sum_float;
} cm_sample_set;

extern const cm_sample_set cm_sample_scalar;
#ifdef CM_HAVE_SSE2
extern const cm_sample_set cm_sample_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const cm_sample_set cm_sample_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const cm_sample_set cm_sample_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const cm_sample_set cm_sample_neon;
#endif

/* The set of that name, which cm_instructions_check has to find good; NULL if it does not. NULL for what the
 * environment says, and without it for the best. */
const cm_sample_set *cm_sample_set_find(const char *name);

#endif
