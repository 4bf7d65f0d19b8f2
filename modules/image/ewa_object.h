/* SPDX-License-Identifier: MIT
 *
 * What elliptic footprints have of a source.
 */
#ifndef MODULES_IMAGE_EWA_OBJECT_H
#define MODULES_IMAGE_EWA_OBJECT_H

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

/* How much of the value is that of spline36: all of it to where the major axis, whose square is given, is one pixel, none
 * from 5/4. */
static inline float cm_ewa_sharpness(float major)
{
    const float rest = major >= 1.5625f ? 0.0f : (1.25f - sqrtf(major)) * 4.0f;
    return rest > 1.0f ? 1.0f : rest;
}

#endif
