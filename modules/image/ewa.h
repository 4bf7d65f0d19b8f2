/* SPDX-License-Identifier: MIT
 *
 * Elliptic footprints on a pyramid: P. S. Heckbert, Fundamentals of texture mapping and image warping, 1989; N. Greene,
 * P. S. Heckbert, Creating raster omnimax images from multiple perspective views using the elliptical weighted average
 * filter, IEEE Computer Graphics and Applications 6, 1986.
 *   kernel         a polynomial that stops 50 dB from 0.92 cycles on and blurs nothing that is smooth, 1.85 target pixels
 *                  each way (research/image/ewa-kernel)
 *   level          the coarsest on which the ellipse's minor axis, of what is one target pixel across, has
 *                  CM_EWA_MINOR pixels or more, of halves or of three eighths and its halves, whichever leaves fewer
 *                  pixels in the footprints of a sample of the target
 *   magnification  the axes are one source pixel at least, and where the major one is less than 5/4 of it, the value goes
 *                  over to that of spline36
 *   long ones      the major axis is shortened until there are no more pixels than the plan allows. What reaches beyond
 *                  the border of a level is taken from the next one, and cut there from the last
 *   poles          of a source in longitude and latitude are done in polar coordinates (ewa_pole.h)
 */
#ifndef MODULES_IMAGE_EWA_H
#define MODULES_IMAGE_EWA_H

#include "ewa_object.h"

/* Ready for pictures of the plan's source; is_whole: levels may be whole numbers (pyramid.h). CM_OK or CM_ERROR_MEMORY;
 * cm_ewa_free frees it. */
cm_status cm_ewa_make(const cm_plan *plan, const cm_image *pictures, const cm_values *values,
                      const cm_sample_set *set, const cm_filter_table *table, int is_whole,
                      unsigned threads, cm_ewa *ewa);

void cm_ewa_free(cm_ewa *ewa);

/* Dense pixels of a group with derivatives. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_ewa_group(const cm_ewa *ewa, const cm_group *group, cm_scratch *scratch, float *to);

#endif
