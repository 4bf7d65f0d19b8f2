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

enum
{
    MOST_WRAPS = 1000 /* of the first series that are told apart */
};

/* How distances of two series come together: the mean of both, and how many wraps of the first there are until both repeat, or
 * as many as are told apart. */
typedef struct series_mean
{
    double unambiguous[2]; /* metres, of each */
    double weight;         /* of the second series */
    int wraps;
    int repeats; /* 0: both do so later */
} series_mean;

/* Of a sensor with two frequencies. */
series_mean series_mean_of(const cm_tof_sensor *sensor);

/* From where on distances repeat, or are not told apart, metres: of two series both together. */
double reconstruct_range(const cm_tof_sensor *sensor);

#endif
