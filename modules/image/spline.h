/* SPDX-License-Identifier: MIT
 *
 * The coefficients of the quintic B-spline that goes through all pixels of a surface, across its seams.
 */
#ifndef MODULES_IMAGE_SPLINE_H
#define MODULES_IMAGE_SPLINE_H

#include "padded.h"

/* Pixels of the border before those that taps reach: the recursions of filter_spline.inc begin there, as if the first
 * pixel stood there for ever, and what is wrong with that has shrunk to 0.43 to this power. */
#define CM_SPLINE_START 16

/* Coefficients of the surface's pictures, in `memory` as of cm_padded_create, and a level that looks at them. cm_padded_free frees both. CM_OK or
 * CM_ERROR_MEMORY. */
cm_status cm_spline_make(const cm_surface *surface, const cm_image *pictures,
                         const cm_values *values, const cm_sample_set *set, const cm_memory *memory,
                         unsigned threads, cm_padded *coefficients, cm_level *level);

/* A level that looks at coefficients. */
void cm_spline_look_at(const cm_padded *coefficients, const cm_values *values, cm_level *level);

#endif
