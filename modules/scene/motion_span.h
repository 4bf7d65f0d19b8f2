/* SPDX-License-Identifier: MIT
 *
 * When a motion begins and ends.
 */
#ifndef MODULES_SCENE_MOTION_SPAN_H
#define MODULES_SCENE_MOTION_SPAN_H

#include <cubemap/trajectory.h>

void cm_motion_span(const cm_motion *motion, double *first, double *last);

#endif
