/* SPDX-License-Identifier: MIT
 *
 * How far what a camera sees moves.
 */
#ifndef CUBEMAP_SIM_SEEN_MOTION_H
#define CUBEMAP_SIM_SEEN_MOTION_H

#include "sensor.h"

/* Radians, at the most, from one time to another: of places that a coarse grid of rays meets, carried along with what they
 * are on. CM_OK; CM_ERROR_MEMORY. */
cm_status seen_motion(const cm_tof_scene *scene, const cm_trajectory *camera,
                      const tof_sensor *sensor, double from, double to, double *most);

#endif
