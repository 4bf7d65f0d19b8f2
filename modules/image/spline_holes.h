/* SPDX-License-Identifier: MIT
 *
 * Numbers that a spline cannot go through: NaN, infinities, and those so large that coefficients overflow. The recursions
 * would spread one over all of its plane. So a number from around it stands there while they run, and its coefficient is
 * NaN afterwards: what a footprint of coefficients touches is NaN, and all else is as if a smooth picture were there.
 */
#ifndef MODULES_IMAGE_SPLINE_HOLES_H
#define MODULES_IMAGE_SPLINE_HOLES_H

#include "padded.h"

/* Coefficients are 7.6 times the largest value at most, of rows and of columns. */
#define CM_SPLINE_MOST 5e36f

/* Find them in planes with their borders, and fill them. has_holes: is there one inside? A look at borders alone finds
 * the others. *holes is NULL if there are none; else free it. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_spline_holes_fill(const cm_padded *padded, const cm_surface *surface,
                               const cm_filter_set *set, int has_holes, unsigned threads,
                               uint64_t **holes);

/* NaN for all that were found. holes may be NULL. */
void cm_spline_holes_put(const cm_padded *padded, const uint64_t *holes);

#endif
