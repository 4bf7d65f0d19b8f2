/* SPDX-License-Identifier: MIT
 *
 * A camera's parameters from pictures of a checkerboard, by OpenCV: corners, then Zhang's calibration with a lens of k1, k2, p1, p2.
 *
 *   pictures   of 8 bits, dense, one after the other; each is softened by 1 pixel before corners are looked for, since steps
 *              along edges that no lens has made say little of where corners are
 *   message    one line of CM_FLOW_MESSAGE bytes at most. Written on failure only
 *   failures   CM_ERROR_ARGUMENT (NULL), CM_ERROR_RANGE (no side or no square, fewer than 2 by 2 corners, no pictures),
 *              CM_ERROR_MEMORY, CM_ERROR_DATA (what OpenCV did not do; the whole board is seen in no picture); the output is
 *              untouched then
 */
#ifndef CUBEMAP_MODULES_SIM_CHECKERBOARD_H
#define CUBEMAP_MODULES_SIM_CHECKERBOARD_H

#include <stdint.h>

#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cm_checkerboard
{
    uint32_t width, height; /* of a picture */
    uint32_t columns, rows; /* of inner corners */
    double square;          /* edge */
} cm_checkerboard;

typedef struct cm_found_lens
{
    double value[8]; /* fx, fy, cx, cy, k1, k2, p1, p2: pixel centres at integers */
    double rms;      /* of corners from where they should be, in pixels */
    uint32_t views;  /* in which the whole board was found */
} cm_found_lens;

cm_status cm_checkerboard_calibrate(const cm_checkerboard *board, uint32_t views,
                                    const uint8_t *pictures, cm_found_lens *found, char *message);

#ifdef __cplusplus
}
#endif

#endif
