/* SPDX-License-Identifier: MIT
 *
 * The truth of a frame as a file of OpenEXR with a part a subject: position (X, Y, Z), normal (X, Y, Z), object, shape,
 * triangle (one channel Y of 32-bit whole numbers), depth, range (Y), flow_next, flow_before (X, Y, Z: columns, rows,
 * metres) and effects, a mask of 0 and 1 for each: flying, motion, multipath, nothing, saturated. What is NULL has no part.
 *
 *   numbers    float; positions are rounded to it. NaN and CM_SCENE_NOTHING stay as they are
 *   packing    runs of equal bytes in whole numbers and masks, where they are long; none in floats, which take longer
 *   message    one line of CM_IMAGE_MESSAGE bytes at most. Written on failure only
 *   failures   CM_ERROR_ARGUMENT (NULL, size, no side, nothing to write), CM_ERROR_MEMORY, CM_ERROR_FILE, and where there was no
 *              OpenEXR when this was built CM_ERROR_UNSUPPORTED
 */
#ifndef CUBEMAP_MODULES_SIM_TRUTH_FILE_H
#define CUBEMAP_MODULES_SIM_TRUTH_FILE_H

#include <stdint.h>

#include <cubemap/sim.h>

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of a picture of width by height, rows dense. flags are those of cm_tof_result, NULL: no masks. A stream that takes no
 * bytes fails. */
cm_status cm_truth_file_write(const cm_image_stream *stream, uint32_t width, uint32_t height,
                              const cm_tof_truth *truth, const uint8_t *flags, char *message);

#ifdef __cplusplus
}
#endif

#endif
