/* SPDX-License-Identifier: MIT
 *
 * What a plan is inside.
 */
#ifndef MODULES_IMAGE_RESAMPLE_PLAN_H
#define MODULES_IMAGE_RESAMPLE_PLAN_H

#include "surface_object.h"

struct cm_plan
{
    cm_surface *from;
    cm_surface *to;
    cm_plan_options options; /* with what a zero stands for filled in */
    cm_memory memory;        /* that options.memory points to, if there is one */
    double turn[3][3];       /* of vectors, from the source's axes to the target's */
};

/* Positions are as exact as this without a word, in source pixels. */
#define CM_TOLERANCE (1.0 / 4096.0)

/* Pixels of the longest EWA footprint without a word. */
#define CM_PIXELS_MOST 4096.0

#endif
