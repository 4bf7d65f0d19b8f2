/* SPDX-License-Identifier: MIT
 *
 * Pixels of any type, to and from floats.
 */
#ifndef MODULES_IMAGE_ENVIRONMENT_PIXELS_H
#define MODULES_IMAGE_ENVIRONMENT_PIXELS_H

#include <cubemap/image.h>

/* Is it a picture with pixels of a known type, 1 to channels_most channels, and width and height of 1 to
 * CM_ENVIRONMENT_SIZE_MAX? CM_OK, CM_ERROR_ARGUMENT (NULL, no data, another size), CM_ERROR_RANGE. */
cm_status cm_pixels_check(const cm_image *image, uint32_t channels_most);

/* Are six pictures square faces that are alike, of a mapping to six faces? As above, and CM_ERROR_UNSUPPORTED. */
cm_status cm_faces_check(const cm_mapping *mapping, const cm_image *faces);

/* The channels of one pixel. Whole numbers are 0 to 1; stored, they are rounded and end there, and NaN is 0. */
void cm_pixel_load(const cm_image *image, uint32_t row, uint32_t column, float *value);
void cm_pixel_store(const cm_image *image, uint32_t row, uint32_t column, const float *value);

/* Rows of a face's picture and rows that go up with v: which one is which is the same both ways. */
uint32_t cm_face_row(const cm_mapping *mapping, uint32_t size, uint32_t row);

#endif
