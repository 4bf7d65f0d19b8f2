/* SPDX-License-Identifier: MIT
 *
 * What OpenCV does for programs, behind a table of functions: it loads more than a hundred libraries, so one library alone
 * links it, which is opened when it is first asked for.
 */
#ifndef CUBEMAP_MODULES_SIM_VISION_H
#define CUBEMAP_MODULES_SIM_VISION_H

#include "checkerboard.h"
#include "optical_flow.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CM_VISION_VERSION 1
#define CM_VISION_ENTRY "cm_vision_entry"

typedef struct cm_vision
{
    uint32_t version; /* CM_VISION_VERSION */
    uint32_t size;    /* sizeof(cm_vision) */

    /* cm_flow_find and cm_checkerboard_calibrate */
    cm_status (*find_flow)(cm_flow_method method, uint32_t width, uint32_t height,
                           const float *from, const float *to, float *flow, char *message);
    cm_status (*calibrate)(const cm_checkerboard *board, uint32_t views, const uint8_t *pictures,
                           cm_found_lens *found, char *message);
} cm_vision;

/* The one function that the library exports: the table of that version, or NULL if it has another. */
const cm_vision *cm_vision_entry(uint32_t version);

/* The table, from a library that stays open: the file that the environment variable CUBEMAP_SIM_VISION names; without it
 * cubemap-sim-vision.so where the running program's folder has it, installed or just built, or where it was to be installed.
 * NULL if there is none, or if this was built without OpenCV: the message, a whole sentence of CM_IMAGE_MESSAGE bytes at most,
 * says why. Any thread may call. */
const cm_vision *cm_vision_get(char *message);

#ifdef __cplusplus
}
#endif

#endif
