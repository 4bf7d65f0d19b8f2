/* SPDX-License-Identifier: MIT
 *
 * What the channels of pixels mean: from stored values to those that may be mixed, and back.
 */
#ifndef MODULES_IMAGE_VALUES_H
#define MODULES_IMAGE_VALUES_H

#include <cubemap/image.h>

/* Values that are mixed are floats: light where the plan says so, multiplied by alpha, and, where numbers that are not
 * finite are to be skipped, with one more channel behind the others that is 1 for a pixel that counts and 0 for one
 * that does not. */
typedef struct cm_values
{
    cm_pixel_type type; /* of what is stored */
    uint32_t channels;  /* that are stored */
    uint32_t working;   /* that are mixed */
    cm_transfer transfer;
    double gamma;
    uint32_t alpha; /* counted from 1; 0: none */
    int alpha_multiplied;
    uint32_t vector; /* counted from 1; 0: none */
    float turn[3][3];
    cm_not_finite not_finite;
    int dither;
} cm_values;

/* Do numbers mean what is stored, but for their type and for those that are not finite? */
int cm_values_are_stored(const cm_values *values);

/* Is what is stored mixed as it is? */
int cm_values_are_plain(const cm_values *values);

/* Is what has been mixed stored as it is? */
int cm_values_are_copied(const cm_values *values);

/* n pixels, one beside the other on the side of floats, `stride` bytes apart on the other. */
void cm_values_load(const cm_values *values, const void *from, ptrdiff_t stride, size_t n,
                    float *to);

/* column and row are the first pixel's place in its picture, by which it is dithered. The floats are overwritten. */
void cm_values_store(const cm_values *values, float *from, size_t n, uint32_t column, uint32_t row,
                     void *to, ptrdiff_t stride);

#endif
