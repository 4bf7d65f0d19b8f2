/* SPDX-License-Identifier: MIT
 *
 * The inverse of a lens for what the loops leave open: Newton's method with steps that stay inside the valid field.
 */
#ifndef MODULES_SCENE_CAMERA_INVERSE_H
#define MODULES_SCENE_CAMERA_INVERSE_H

#include "camera_image.h"

/* The inside ray of which the lens makes the aim, up to slack. 1, or 0 if there is none. */
int cm_camera_solve(const cm_lens *lens, const cm_camera_set *set, const cm_camera_field *field,
                    cm_camera_reach reach, const double aim[2], double slack, double ray[2]);

#endif
