/* SPDX-License-Identifier: MIT
 *
 * All of a target from splines whose coefficients are made stripe by stripe (spline_stripes.h): its blocks come in the order
 * in which the source has what they need.
 */
#ifndef MODULES_IMAGE_RESAMPLE_STRIPES_H
#define MODULES_IMAGE_RESAMPLE_STRIPES_H

#include "block_target.h"

/* *is_done is 0 if it cannot be done so, or saves too little; the target is then of any value. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_resample_stripes(const cm_target *target, unsigned threads, int *is_done);

#endif
