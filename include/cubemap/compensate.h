/* SPDX-License-Identifier: MIT
 *
 * Motion in pictures whose channels are taken one after the other: phase images of time-of-flight cameras, channels of
 * multispectral ones. Of the library cubemap-sim.
 *
 *   channels   n of a frame, evenly apart in time; the next frame's first comes as soon after the last. Channel 0 is the
 *              reference: all others are moved to where things were then
 *   pictures   dense, row by row; channels one behind the other. Any unit; NaN spreads no further than a pixel
 *   flows      from one picture to another, 2 floats a pixel of the first: columns, rows to where its content is in the
 *              second. What is not finite says that nothing is known: it is not moved
 *   moving     of what comes to one pixel the faster lies in front, as nearer things do; between pixels by the cubic of
 *              Keys 1981. Where nothing comes, the pixel's own flow says what was there
 *   threads    the same bits for any number of them
 *   errors     CM_ERROR_ARGUMENT for NULL, CM_ERROR_RANGE for numbers that cannot be (sides of 0, 2^31 pixels, 64 channels),
 *              CM_ERROR_MEMORY; outputs are untouched then
 *   source     Steiner and others, Fast motion estimation for field sequential imaging, 2019; flows are the caller's
 */
#ifndef CUBEMAP_COMPENSATE_H
#define CUBEMAP_COMPENSATE_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>
#include <cubemap/pool.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Channels of a frame, at most. */
#define CM_COMPENSATE_CHANNELS_MAX 64

/* ---- schemes ---- */

/* Which pictures are compared. Corresponding channel matching (CCM) compares a channel with the same of the frame before,
 * neighboring channel matching (NCM) with the next in time, which looks different. */
typedef enum cm_compensation
{
    CM_CCM_B = 0, /* every channel, both ways, and the mean of both; eq. 2. 2 (n - 1) flows */
    CM_CCM_U = 1, /* every channel, the shorter way; eq. 3. n - 1 flows */
    CM_CCM_2 = 2, /* channels 1 and n - 1; between them by eq. 5. Two flows; 4 channels or more */
    CM_CCM_1 = 3, /* channel 1, whose flow is that of all; eq. 4. One flow; 2 channels or more */
    CM_NCM = 4,   /* neighbours within the frame; eq. 6. n - 1 flows */
    CM_NCM_NEAREST =
        5 /* the same to the nearer reference, from the frame before too; eq. 7. n - 1 flows */
} cm_compensation;

/* "CCM-B" and so on; NULL for others. */
CM_API const char *cm_compensation_name(cm_compensation scheme);

/* A flow goes from one picture to another. */
typedef struct cm_flow_pair
{
    int from_frame;        /* 0: this frame, -1: the one before */
    uint32_t from_channel; /* 0 to n - 1 */
    int to_frame;          /* as from_frame */
    uint32_t to_channel;   /* as from_channel */
} cm_flow_pair;

/* The flows that a scheme needs, in the order in which cm_compensate takes them. *count is how many, also when there is no
 * room for them. pair may be NULL if there is none.
 * CM_OK; CM_ERROR_ARGUMENT (NULL, no such scheme); CM_ERROR_RANGE (less than 2 channels, CM_CCM_2: than 4); CM_ERROR_SPACE. */
CM_API cm_status cm_compensation_flows(cm_compensation scheme, uint32_t channels, size_t room,
                                       cm_flow_pair *pair, size_t *count);

/* What is to be compensated. */
typedef struct cm_compensation_input
{
    size_t size;         /* sizeof(cm_compensation_input) */
    uint32_t width;      /* of each picture */
    uint32_t height;     /* of each picture */
    uint32_t channels;   /* n */
    const float *now;    /* n pictures */
    const float *before; /* n pictures of the frame before; CM_NCM does not need it */
    const float *flow;   /* those of cm_compensation_flows, one behind the other */
} cm_compensation_input;

/* All channels at the time of the first. corrected: n pictures, which overlap no input; the first is a copy. In CM_CCM_B
 * what both flows do not agree on is hidden in one picture (Sundaram, Brox and Keutzer 2010) and counts where the other has
 * nothing. A pool of NULL: the calling thread.
 * CM_OK; CM_ERROR_ARGUMENT (size, a picture that is needed); CM_ERROR_RANGE; CM_ERROR_MEMORY. */
CM_API cm_status cm_compensate(const cm_compensation_input *input, cm_compensation scheme,
                               cm_pool *pool, float *corrected);

/* One picture moved by a part of its flow: F[C] of the paper. coverage: how much of something came to each pixel, 0..1; NULL:
 * not wanted. No output may overlap an input. part from -1000 to 1000. */
CM_API cm_status cm_flow_warp(uint32_t width, uint32_t height, const float *picture,
                              const float *flow, double part, float *moved, float *coverage);

/* Pixelwise artifact correction (Schmidt and Jaehne 2011, as Steiner and others tell of it): where channel 0 is that of the
 * frame before to within a threshold and a later one is not, something came in between; from there on the frame before's
 * are taken. Uses no flow. corrected may be now; changed, the pixels that were, may be NULL. threshold from 0 on.
 * CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE. */
CM_API cm_status cm_compensate_pixelwise(const cm_compensation_input *input, double threshold,
                                         float *corrected, size_t *changed);

/* ---- what makes channels comparable ---- */

/* Lengths of the gradient by Sobel's operator, per pixel; beyond the borders the border's values. Not in place. */
CM_API cm_status cm_channel_gradient(uint32_t width, uint32_t height, const float *picture,
                                     float *gradient);

/* The census of 3 x 3 pixels (Zabih and Woodfill 1994): bit k is 1 if neighbour k, by rows, is less than the pixel; beyond the
 * borders the border's values. */
CM_API cm_status cm_channel_census(uint32_t width, uint32_t height, const float *picture,
                                   uint8_t *census);

/* From the least and greatest finite value to 0..most; a constant picture becomes 0. to may be picture. most above 0. */
CM_API cm_status cm_channel_normalize(uint32_t width, uint32_t height, const float *picture,
                                      double most, float *to);

/* (I - mean) / deviation of the window of 2 radius + 1 pixels each way, as far as it is in the picture; eq. 8, whose
 * "variance" is the standard deviation. 0 where that is 0 to rounding; values that are not finite count for nothing and
 * become NaN. radius from 1 to 1000. Not in place. */
CM_API cm_status cm_channel_normalize_locally(uint32_t width, uint32_t height, const float *picture,
                                              uint32_t radius, float *to);

/* How many are no greater, as a part of all, in so many steps from the least to the greatest; eq. 9. bins from 2 to 65536. to
 * may be picture. */
CM_API cm_status cm_channel_equalize(uint32_t width, uint32_t height, const float *picture,
                                     uint32_t bins, float *to);

/* Contrast limited adaptive equalization (Zuiderveld 1994): eq. 9 of 256 bins in each of tiles x tiles parts, linear between
 * their centres; what a bin holds above limit times the mean of all bins is shared out among all. A part without a finite
 * value is left out. limit from 1 on; tiles from 1 to 64, and no more than pixels of a side. to may be picture. */
CM_API cm_status cm_channel_equalize_locally(uint32_t width, uint32_t height, const float *picture,
                                             uint32_t tiles, double limit, float *to);

#ifdef __cplusplus
}
#endif

#endif
