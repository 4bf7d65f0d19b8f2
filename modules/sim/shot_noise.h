/* SPDX-License-Identifier: MIT
 *
 * Shot noise as cameras were measured to have it: normal numbers in the space of Freeman and Tukey's transform.
 */
#ifndef CUBEMAP_SIM_SHOT_NOISE_H
#define CUBEMAP_SIM_SHOT_NOISE_H

#include <cubemap/sim.h>

/* Is the sensor's polynomial one? CM_OK; CM_ERROR_ARGUMENT; CM_ERROR_RANGE. */
cm_status shot_noise_check(const cm_tof_sensor *sensor);

/* n charges, electrons of 0 or more, get noise by numbers of mean 0 and standard deviation 1. */
void shot_noise_add(const cm_tof_sensor *sensor, size_t n, const double *normal, double *charge);

/* The variance of a charge, electrons, after it got noise: by the transform's way back to second order. */
double shot_noise_variance(const cm_tof_sensor *sensor, double charge);

#endif
