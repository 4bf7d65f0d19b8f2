/* SPDX-License-Identifier: MIT
 *
 * Pictures that are drawn into: what they must be, and their pixels.
 */
#ifndef MODULES_OCTREE_PICTURE_H
#define MODULES_OCTREE_PICTURE_H

#include <cubemap/image.h>

/* Has it pixels of that size, and from so many channels to so many? CM_OK; CM_ERROR_ARGUMENT (no pixels, or a wrong size of the
 * struct); CM_ERROR_RANGE. */
cm_status cm_picture_check(const cm_image *image, uint32_t width, uint32_t height, uint32_t least,
                           uint32_t most);

/* Where a pixel is. */
void *cm_picture_at(const cm_image *image, size_t column, size_t row);

/* Values of 0 to 1 to the first channels of a pixel, of CM_PIXEL_U8, _U16 or _FLOAT. */
void cm_picture_write(const cm_image *image, size_t column, size_t row, const float *value,
                      uint32_t channels);

/* Is any channel of a pixel not 0? */
int cm_picture_is_set(const cm_image *image, size_t column, size_t row);

#endif
