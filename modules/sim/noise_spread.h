/* SPDX-License-Identifier: MIT
 *
 * What noise does to distances, by formulas: one frame's noise is one of many.
 */
#ifndef CUBEMAP_SIM_NOISE_SPREAD_H
#define CUBEMAP_SIM_NOISE_SPREAD_H

#include <cubemap/sim.h>

/* Of a frame without noise. */
typedef struct noise_charges
{
    size_t pixels;
    const float *charge_a, *charge_b; /* series x phases x pixels */
    const float *amplitude;           /* of the first series */
} noise_charges;

/* Metres: the root of the mean square over pixels of what shot noise of a kind, the circuits' and the fixed pattern change. What
 * is not modulated light is noise alone. */
double noise_spread(const cm_tof_sensor *sensor, int shot, const noise_charges *of);

#endif
