/* SPDX-License-Identifier: MIT
 *
 * The inverse of a lens for what the loops leave open: Newton's method with steps that stay inside the valid field.
 */
#ifndef MODULES_SCENE_CAMERA_INVERSE_H
#define MODULES_SCENE_CAMERA_INVERSE_H

#include "camera_image.h"
#include "camera_net.h"

/* What is solved: where, for what, and how well. */
typedef struct cm_camera_search
{
    const cm_lens *lens;
    const cm_camera_set *set;
    const cm_camera_field *field;
    cm_camera_net *net; /* made when it is needed */
    double pixel[2];
    double aim[2]; /* in focal lengths, the tilt undone */
    double slack;  /* what the residual may be */
} cm_camera_search;

/* Does the lens make something else of a ray than the aim, by more than rounding? */
int cm_camera_is_off(const cm_camera_search *search, const double ray[2]);

/* The inside ray of which the lens makes the aim, up to slack. 1, or 0 if none was found. */
int cm_camera_solve(const cm_camera_search *search, cm_camera_reach reach, double ray[2]);

#endif
