/* SPDX-License-Identifier: MIT
 *
 * How far one picture is from another, its reference. Of the library cubemap-image, which knows no file.
 *
 *   pictures    as in image.h, of one size and as many channels; whole numbers are 0 to 1. Types may differ
 *   weights     a picture of floats, 0 or more, with one channel; of the pictures' size, or one pixel wide, then for
 *               whole rows. The solid angle of each pixel makes PSNR WS-PSNR. Pixels of weight 0 do not count
 *   error       picture minus reference
 *   results     the same bits for any number of threads, and however the rows are handed over
 *   not finite  NaN and infinities are counted, and never a silent part of a figure: cm_compare_not_finite
 *   errors      a call that fails leaves figures untouched; a map may be written in part
 *   example     cm_image reference = {sizeof reference, pixels, CM_PIXEL_U8, 512, 256, 3, 0, 0}, picture = ...;
 *               cm_error_figures figures = {sizeof figures};
 *               cm_compare_errors(&reference, &picture, NULL, &figures); figures.psnr is in dB; docs/guide/comparing.md
 */
#ifndef CUBEMAP_COMPARE_H
#define CUBEMAP_COMPARE_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/image.h>
#include <cubemap/mapping.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- what all measures share ---- */

/* What becomes of NaN and infinities in either picture. CM_COMPARE_ALIKE is for errors of single values alone. */
typedef enum cm_compare_not_finite
{
    CM_COMPARE_REFUSE = 0, /* CM_ERROR_RANGE if a pixel that counts has one, or one in its window */
    CM_COMPARE_SKIP = 1,   /* such pixels do not count */
    CM_COMPARE_ALIKE = 2 /* two NaN, or the same infinity, are alike; else the error is infinite */
} cm_compare_not_finite;

/* To be filled with zeros but for size, and for what is wanted.
 *   peak        0 is 1 if the reference holds whole numbers, else the greatest value of the reference that counts, or 1
 *               if that is not above 0; else from 1e-100 to 1e100
 *   exposures   of HDR-FLIP, in powers of two, equally far apart; the reference tells them if exposure_count is 0 */
typedef struct cm_compare_options
{
    size_t size;                      /* sizeof(cm_compare_options) */
    const cm_image *weights;          /* of whole pictures; NULL: all pixels weigh 1 */
    uint32_t border;                  /* pixels at all edges that are looked at, and do not count */
    cm_compare_not_finite not_finite; /* what becomes of NaN and infinities */
    double peak;                      /* the greatest value that there can be; 0 as above */
    double pixels_per_degree; /* FLIP: of the visual field, 0.01 to 1000; 0 for FLIP's standard */
    int linear;               /* FLIP of low dynamic range: are values linear light, else sRGB? */
    double exposure_start;    /* the first exposure */
    double exposure_stop;     /* the last one, not below the first */
    uint32_t exposure_count;  /* how many, CM_FLIP_EXPOSURES_MAX at most; 0 as above */
    unsigned threads;         /* as in threads.h: 0 for all */
} cm_compare_options;

/* ---- errors of single values: MSE, PSNR, WS-PSNR, S-PSNR ---- */

/* The channel that stands for all of them together. */
#define CM_ALL_CHANNELS UINT32_MAX

/* Of one channel or of all; size must be sizeof(cm_error_figures) before the call. With no pixel that counts, means are
 * NaN. Infinite errors, which only CM_COMPARE_ALIKE has, make mean_signed NaN and the others infinite. */
typedef struct cm_error_figures
{
    size_t size;              /* sizeof(cm_error_figures) */
    uint64_t pixels;          /* that count */
    uint64_t not_finite;      /* pixels of a weight above 0 with a NaN or an infinity */
    double weight;            /* the sum of the weights of those that count */
    double mse;               /* the weighted mean of the squares of errors */
    double rmse;              /* its root */
    double mean_absolute;     /* the weighted mean of |error| */
    double mean_signed;       /* the weighted mean of the error */
    double largest;           /* the greatest |error| */
    uint64_t largest_row;     /* where that is, the first place row by row; 0 if there is none */
    uint32_t largest_column;  /* as before */
    uint32_t largest_channel; /* as before */
    double peak;              /* of psnr */
    double psnr;              /* cm_psnr(mse, peak), dB; with solid angles as weights, WS-PSNR */
} cm_error_figures;

/* 10 log10(peak^2 / mse), in dB; infinite if mse is 0. */
CM_API double cm_psnr(double mse, double peak);

/* Errors over all channels of two whole pictures. With solid angles as weights, figures->psnr is WS-PSNR (Y. Sun, A.
 * Lu, L. Yu, IEEE Signal Processing Letters 24, 2017). options may be NULL.
 * Errors: CM_ERROR_ARGUMENT (a NULL, a size, a picture or an option that is none), CM_ERROR_RANGE (pictures that are
 * not alike, weights that are not finite or negative, NaN and infinities that are refused), CM_ERROR_MEMORY. */
CM_API cm_status cm_compare_errors(const cm_image *reference, const cm_image *picture,
                                   const cm_compare_options *options, cm_error_figures *figures);

/* The same for n points, 1 to UINT32_MAX, with channels floats each, one beside the other: at cm_sphere_points,
 * figures->psnr is S-PSNR (M. Yu, H. Lakshman, B. Girod, ISMAR 2015). weights of options, if any, is n wide and 1
 * high. */
CM_API cm_status cm_compare_values(size_t n, uint32_t channels, const float *reference,
                                   const float *picture, const cm_compare_options *options,
                                   cm_error_figures *figures);

/* Errors of pictures that come in rows, from cm_errors_create to cm_errors_destroy. One thread at a time may add. */
typedef struct cm_errors cm_errors;

/* channels as in cm_image. Of options, which may be NULL, border and weights must be 0. On success *errors is to be
 * given to cm_errors_destroy. Errors: CM_ERROR_ARGUMENT, CM_ERROR_MEMORY. */
CM_API cm_status cm_errors_create(uint32_t channels, const cm_compare_options *options,
                                  cm_errors **errors);

/* NULL is allowed. */
CM_API void cm_errors_destroy(cm_errors *errors);

/* The next rows, from the top, in blocks of any height, and their weights; NULL: all weigh 1.
 * Errors: those of cm_compare_errors; nothing is added then. */
CM_API cm_status cm_errors_add(cm_errors *errors, const cm_image *reference,
                               const cm_image *picture, const cm_image *weights);

/* What was found so far, of one channel or of CM_ALL_CHANNELS. Errors: CM_ERROR_ARGUMENT. */
CM_API cm_status cm_errors_get(const cm_errors *errors, uint32_t channel,
                               cm_error_figures *figures);

/* ---- measures with windows: SSIM and FLIP ---- */

/* size must be sizeof(cm_map_figures) before the call. With no pixel that counts, numbers are NaN. */
typedef struct cm_map_figures
{
    size_t size;         /* sizeof(cm_map_figures) */
    uint64_t pixels;     /* that count */
    uint64_t not_finite; /* pixels of a weight above 0 with a NaN or an infinity in their window */
    double weight;       /* the sum of the weights of those that count */
    double mean;         /* the weighted mean of the measure */
    double lowest;       /* its least value */
    double highest;      /* its greatest value */
    uint32_t lowest_column;  /* where the least is, the first place row by row */
    uint32_t lowest_row;     /* as before */
    uint32_t highest_column; /* where the greatest is */
    uint32_t highest_row;    /* as before */
    double exposure_start;   /* HDR-FLIP: the exposures that were taken; else 0 */
    double exposure_stop;    /* as before */
    uint32_t exposure_count; /* as before */
} cm_map_figures;

/* Structural similarity (Z. Wang et al., IEEE Transactions on Image Processing 13, 2004): 11 x 11 Gaussian window with
 * sigma = 1.5, K1 = 0.01, K2 = 0.03, L = peak, of each channel alone; that of a pixel is the mean over its channels.
 * At the pictures' edges the window is what is left of it, its weights brought to the sum 1 again. A border of 5 counts
 * whole windows alone, as the paper has it. What does not count is NaN in map.
 * figures, map (floats, one channel, of the pictures' size) and channel_means (as many as channels) may be NULL, and so
 * may options. Errors: those of cm_compare_errors. */
CM_API cm_status cm_ssim(const cm_image *reference, const cm_image *picture,
                         const cm_compare_options *options, cm_map_figures *figures,
                         const cm_image *map, double *channel_means);

/* The pixels per degree of a display 0.7 m wide with 3840 pixels, from 0.7 m: FLIP's standard. */
#define CM_FLIP_PIXELS_PER_DEGREE 67.02064327658226

/* FLIP, 0 to 1, what is seen when two pictures take turns (P. Andersson et al., Proceedings of the ACM on Computer
 * Graphics 3, 2020, with the constants of the authors' program). The first three channels are red, green and blue; with
 * one or two, the first is grey. Values outside 0 to 1 count as 0 or 1. Pixels at the edges go on outside.
 * figures, map and options as for cm_ssim. Errors: those of cm_compare_errors. */
CM_API cm_status cm_flip(const cm_image *reference, const cm_image *picture,
                         const cm_compare_options *options, cm_map_figures *figures,
                         const cm_image *map);

/* HDR-FLIP: the greatest FLIP over exposures, after tone mapping with the curve of ACES (P. Andersson et al.,
 * Eurographics Short Papers 2021). Values are linear light of any size; negative ones count as 0. Without
 * exposure_count, the exposures bring the reference's greatest luminance and its median to 0.85, one a power of two,
 * two at least; the median is of those above 0 if half are 0, and a black reference has the exposure 0 alone. At most
 * CM_FLIP_EXPOSURES_MAX. figures, map and options as for cm_ssim. Errors: those of cm_compare_errors. */
CM_API cm_status cm_flip_hdr(const cm_image *reference, const cm_image *picture,
                             const cm_compare_options *options, cm_map_figures *figures,
                             const cm_image *map);

/* No more exposures are taken; the range of float's luminances needs fewer. */
#define CM_FLIP_EXPOSURES_MAX 1024

/* ---- weights and points ---- */

/* The solid angle of each pixel of the rows of an equirectangular picture, width x height pixels: height floats, a
 * picture of weights one pixel wide. Errors: CM_ERROR_ARGUMENT. */
CM_API cm_status cm_equirect_weights(uint32_t width, uint32_t height, float *weights);

/* The solid angle of each pixel of a face, by the Jacobian at its centre: edge x edge floats, rows from v = -1, columns
 * from u = -1. Of a mapping with one face, face is 0. Where the Jacobian is not finite, outside a disc and where a
 * mapping is singular, the weight is 0. Errors: CM_ERROR_ARGUMENT. */
CM_API cm_status cm_face_weights(const cm_mapping *mapping, uint8_t face, uint32_t edge,
                                 unsigned threads, float *weights);

/* As many points as S-PSNR was proposed with. */
#define CM_SPHERE_POINTS 655362

/* Points first to first + count - 1 of n that are evenly spread over the sphere: a Fibonacci lattice, z from 1 - 1/n
 * down in equal steps, longitudes in golden steps (A. Gonzalez, Mathematical Geosciences 42, 2010). Unit directions
 * into x, y and z, count numbers each. Errors: CM_ERROR_ARGUMENT if a pointer is NULL or points are not among the n. */
CM_API cm_status cm_sphere_points(uint64_t n, uint64_t first, size_t count, double *x, double *y,
                                  double *z);

/* ---- pictures of differences ---- */

/* The greatest |error| over the channels of each pixel, into map, as for cm_ssim; NaN where a value is not finite.
 * Errors: CM_ERROR_ARGUMENT, CM_ERROR_RANGE (pictures that are not alike), CM_ERROR_MEMORY. */
CM_API cm_status cm_difference_map(const cm_image *reference, const cm_image *picture,
                                   unsigned threads, const cm_image *map);

/* The colour of a place t in 0 to 1, or NaN: red, green and blue, 0 to 1. */
typedef void (*cm_map_color)(double t, double color[3], void *user);

/* A map in colours: low has the colour of 0, high that of 1, values beyond the nearer of the two, NaN that of NaN. to
 * has the map's size and 3 channels, or 4, of which the last becomes 1; whole numbers are rounded, and what a colour
 * has outside 0 to 1, or NaN, is 0 or 1, or 0. *beyond, unless it is NULL, is how many values were below low or above
 * high. Errors: CM_ERROR_ARGUMENT (high not above low, too), CM_ERROR_RANGE (another size or number of channels). */
CM_API cm_status cm_draw_map(const cm_image *map, double low, double high, cm_map_color color,
                             void *user, const cm_image *to, uint64_t *beyond);

#ifdef __cplusplus
}
#endif

#endif
