/* SPDX-License-Identifier: MIT
 *
 * Distances, amplitudes and intensities of charges.
 */
#ifndef CUBEMAP_SIM_RECONSTRUCT_H
#define CUBEMAP_SIM_RECONSTRUCT_H

#include "sensor.h"
#include "tof_set.h"

/* Into the arrays of result that are not NULL; flags may be NULL. */
void reconstruct(const tof_set *set, const cm_tof_sensor *sensor, size_t n, const float *charge_a,
                 const float *charge_b, cm_pool *pool, const cm_tof_result *result, uint8_t *flags);

#endif
