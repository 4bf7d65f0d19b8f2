/* SPDX-License-Identifier: MIT
 *
 * The cheapest filter that is good enough for a picture, by a sample of the target's blocks that is always the same.
 *   ewa          if the minor axis of a footprint is above 1.2 source pixels anywhere, or the major one is on more than
 *                half of the sample: meridians that meet at a pole are no reason
 *   nearest      if all positions are centres of pixels
 *   bilinear, catmull-rom, spline36
 *                the first whose values differ from those of the quintic spline by no more, in the root mean square, than
 *                the output's rounding does: 1 / sqrt(12) of a step of whole numbers, 2^-11 of the values' own root mean
 *                square for halves. Floats have no such step: 1e-4 of the range of values, 80 dB, is less than what nearly
 *                all that is measured or rendered has as noise
 *   bspline5     else, and where no block could be compared
 */
#ifndef MODULES_IMAGE_AUTO_H
#define MODULES_IMAGE_AUTO_H

#include "resample_plan.h"
#include "sample_set.h"
#include "values.h"

/* For pictures whose values are those. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_auto_filter(const cm_plan *plan, const cm_image *from, const cm_values *values,
                         const cm_sample_set *set, cm_pixel_type target_type, cm_filter *filter);

#endif
