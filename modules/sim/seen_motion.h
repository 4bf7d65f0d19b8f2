/* SPDX-License-Identifier: MIT
 *
 * How far what a camera sees moves.
 */
#ifndef CUBEMAP_SIM_SEEN_MOTION_H
#define CUBEMAP_SIM_SEEN_MOTION_H

#include "sensor.h"

/* The most of each, of places that are seen. */
typedef struct seen_movement
{
    double angle; /* radians, across the picture */
    double range; /* metres, nearer or farther */
} seen_movement;

/* What moves from one time to another, added to *most where it is more: places that a coarse grid of rays meets at either time,
 * and the middles of what moves, which may be smaller than that, carried along with what they are on.
 * CM_OK; CM_ERROR_MEMORY. */
cm_status seen_motion(const cm_tof_scene *scene, const cm_trajectory *camera,
                      const tof_sensor *sensor, double from, double to, seen_movement *most);

#endif
