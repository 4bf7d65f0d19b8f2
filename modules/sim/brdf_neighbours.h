/* SPDX-License-Identifier: MIT
 *
 * Means of measurements around two directions (Bulczak, Lambers and Kolb 2018, eqs. 16 and 17).
 */
#ifndef CUBEMAP_SIM_BRDF_NEIGHBOURS_H
#define CUBEMAP_SIM_BRDF_NEIGHBOURS_H

#include <cubemap/brdf.h>

typedef struct brdf_neighbours brdf_neighbours;

/* NULL: no memory. */
brdf_neighbours *brdf_neighbours_create(size_t n, const cm_brdf_sample *sample);
void brdf_neighbours_destroy(brdf_neighbours *neighbours);

double brdf_neighbours_mean(const brdf_neighbours *neighbours, double theta_in, double theta_out,
                            double azimuth);

#endif
