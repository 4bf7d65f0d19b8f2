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

#include "filter_set.h"
#include "geometry.h"
#include "pyramid.h"

#include <math.h>

/* Each level has what is finer than three quarters of its frequency 50 dB down, so that the kernel needs no more pixels. */
#define CM_EWA_MINOR 1.03

typedef struct cm_ewa
{
    const cm_filter_set *set;
    const cm_filter_table *table; /* of spline36 */
    const cm_surface *surface;    /* of the source */
    cm_pyramid pyramid;
    cm_ewa_kernel kernel;
    float pixels_most;
    uint32_t width[CM_LEVELS_MAX]; /* of levels */
    uint32_t height[CM_LEVELS_MAX];
    float least
        [CM_LEVELS_MAX]; /* the square of the minor axis that a level needs, in source pixels */
    float cap[CM_LEVELS_MAX];  /* source rows from a pole: what is beside it */
    float wide[CM_LEVELS_MAX]; /* and where ellipses may be too wide for a level */
} cm_ewa;

/* Ready for pictures of the plan's source; is_whole: levels may be whole numbers (pyramid.h). CM_OK or CM_ERROR_MEMORY;
 * cm_ewa_free frees it. */
cm_status cm_ewa_make(const cm_plan *plan, const cm_image *pictures, const cm_values *values,
                      const cm_sample_set *set, const cm_filter_table *table, int is_whole,
                      unsigned threads, cm_ewa *ewa);

void cm_ewa_free(cm_ewa *ewa);

/* How much of the value is that of spline36: all of it to where the major axis, whose square is given, is one pixel, none
 * from 5/4. */
static inline float cm_ewa_sharpness(float major)
{
    const float rest = major >= 1.5625f ? 0.0f : (1.25f - sqrtf(major)) * 4.0f;
    return rest > 1.0f ? 1.0f : rest;
}

/* Dense pixels of a group with derivatives. CM_OK or CM_ERROR_MEMORY. */
cm_status cm_ewa_group(const cm_ewa *ewa, const cm_group *group, cm_scratch *scratch, float *to);

#endif
