/* SPDX-License-Identifier: MIT
 *
 * Depth images as NumPy writes arrays, NPY 1.0 to 3.0 (numpy.lib.format): of two dimensions, rows first, numbers of 16-bit
 * unsigned or of floating point, in either order of bytes and of axes.
 *
 *   message     one line of CM_IMAGE_MESSAGE bytes at most, "FILE: what is wrong". Written on failure only
 *   failures    CM_ERROR_ARGUMENT, CM_ERROR_MEMORY, CM_ERROR_FILE, CM_ERROR_DATA
 */
#ifndef CUBEMAP_MODULES_SCENE_NPY_FILE_H
#define CUBEMAP_MODULES_SCENE_NPY_FILE_H

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The array of count bytes as a dense picture of one channel, CM_PIXEL_U16 or CM_PIXEL_FLOAT, whose data are for free().
 * name is for the message. */
cm_status cm_npy_parse(const char *name, const void *bytes, size_t count, cm_image *picture,
                       char *message);
cm_status cm_npy_read(const char *path, cm_image *picture, char *message);

/* Write a picture of one channel, CM_PIXEL_U16 or CM_PIXEL_FLOAT, as NPY 1.0. The file appears when it is complete. */
cm_status cm_npy_write(const char *path, const cm_image *picture, char *message);

#ifdef __cplusplus
}
#endif

#endif
