/* SPDX-License-Identifier: MIT
 *
 * Optical flows between pictures by OpenCV 4.5 or newer, as cm_compensate takes them. Built without it, there are none.
 *
 *   pictures   dense, row by row, any unit: the values of both from their least to their greatest become 0..255 of 8 bits,
 *              of TV-L1 0..1; what is not finite becomes the least. Pictures of one value have a flow of 0.
 *              Sides of 16 to 16384 pixels, for RLOF 48
 *   parameters OpenCV's own, but for what cm_flow_method says
 *   threads    OpenCV's: cv::setNumThreads
 *   message    one line of CM_FLOW_MESSAGE bytes at most. Written on failure only
 *   failures   CM_ERROR_ARGUMENT (NULL, no such method), CM_ERROR_RANGE (sides), CM_ERROR_MEMORY, CM_ERROR_UNSUPPORTED (no OpenCV),
 *              CM_ERROR_DATA (what OpenCV did not do); outputs are untouched then
 */
#ifndef CUBEMAP_MODULES_SIM_OPTICAL_FLOW_H
#define CUBEMAP_MODULES_SIM_OPTICAL_FLOW_H

#include <stdint.h>

#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CM_FLOW_MESSAGE 256
#define CM_FLOW_SIDE_LEAST 16u
#define CM_FLOW_SIDE_LEAST_RLOF 48u
#define CM_FLOW_SIDE_MOST 16384u

typedef enum cm_flow_method
{
    CM_FLOW_DIS = 0,       /* inverse search in patches, MEDIUM: Kroeger and others 2016 */
    CM_FLOW_FARNEBACK = 1, /* polynomials, 3 levels, windows of 15: Farneback 2003 */
    CM_FLOW_TVL1 = 2,      /* total variation and L1: Zach and others 2007 */
    CM_FLOW_LK = 3,        /* Lucas and Kanade 1981 at points of a grid, dense along edges */
    CM_FLOW_RLOF = 4       /* the same, robust and local: Geistert and others 2016 */
} cm_flow_method;

#define CM_FLOW_METHODS 5

/* "dis", "farneback", "tvl1", "lk", "rlof"; NULL for others. */
const char *cm_flow_method_name(cm_flow_method method);

/* 1 if this was built with OpenCV. */
int cm_flow_is_there(void);

/* The flow from one picture to another: 2 floats for each pixel of from. All NaN where LK and RLOF follow less than 8
 * points. */
cm_status cm_flow_find(cm_flow_method method, uint32_t width, uint32_t height, const float *from,
                       const float *to, float *flow, char *message);

#ifdef __cplusplus
}
#endif

#endif
