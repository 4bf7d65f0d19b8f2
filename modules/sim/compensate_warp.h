/* SPDX-License-Identifier: MIT
 *
 * Flows carried along by themselves, and pictures moved by them.
 */
#ifndef MODULES_SIM_COMPENSATE_WARP_H
#define MODULES_SIM_COMPENSATE_WARP_H

#include <stddef.h>
#include <stdint.h>

/* The size of all pictures of a call. */
typedef struct cm_picture_size
{
    uint32_t width;
    uint32_t height;
} cm_picture_size;

/* What carrying needs beside its results, for each pixel. */
typedef struct cm_warp_desk
{
    uint32_t *front; /* the pixel that lies in front where it comes to; NO_PIXEL */
    float *sum;      /* three: of weights, and of differences from the front's flow */
} cm_warp_desk;

/* Whether there are pictures of that size, of fewer than 2^31 pixels. */
int cm_is_picture_size(uint32_t width, uint32_t height);
size_t cm_pixels_of(cm_picture_size size);

/* The flow of what is at each pixel after a part of its way, and how much came there. Pixels with doubtful[i] != 0 count where
 * no others come, and little; doubtful may be NULL. Where nothing comes: the pixel's own, or 0 if that is not finite. */
void cm_carry_flow(cm_picture_size size, const float *flow, const uint8_t *doubtful, double part,
                   const cm_warp_desk *desk, float *carried, float *coverage);

/* The picture's content after a part of the way, by a flow that was carried so far. */
void cm_draw_moved(cm_picture_size size, const float *picture, const float *carried, double part,
                   float *moved);

/* The flow at a place, linear between pixels and constant beyond the border. */
void cm_flow_at(cm_picture_size size, const float *flow, double column, double row, double d[2]);

#endif
