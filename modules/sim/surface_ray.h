/* SPDX-License-Identifier: MIT
 *
 * Rays that begin on surfaces.
 */
#ifndef CUBEMAP_SIM_SURFACE_RAY_H
#define CUBEMAP_SIM_SURFACE_RAY_H

#include "tof_object.h"

#include <math.h>

/* Where a ray begins that leaves a surface: a little above it. */
static inline void leave_surface(const double position[3], const double normal[3], double from[3])
{
    const double most =
        fmax(1.0, fmax(fabs(position[0]), fmax(fabs(position[1]), fabs(position[2]))));
    for (int k = 0; k < 3; k++)
    {
        from[k] = position[k] + 1e-9 * most * normal[k];
    }
}

typedef struct lamp_ray
{
    double direction[3]; /* to the lamp, of length 1 */
    double distance;
} lamp_ray;

/* The lamp's irradiance of a surface, where nothing is between them, W/m^2. */
static inline double find_lamp_ray(const tof_lamp *lamp, const double at[3], const double normal[3],
                                   lamp_ray *ray)
{
    double square = 0.0;
    double incidence = 0.0;
    double cosine = 0.0;
    for (int k = 0; k < 3; k++)
    {
        ray->direction[k] = lamp->position[k] - at[k];
        square += ray->direction[k] * ray->direction[k];
    }
    ray->distance = sqrt(square);
    for (int k = 0; k < 3; k++)
    {
        ray->direction[k] /= ray->distance;
        incidence += ray->direction[k] * normal[k];
        cosine -= ray->direction[k] * lamp->axis[k];
    }
    return incidence > 0.0 ? tof_lamp_intensity(lamp, cosine) * incidence / square : 0.0;
}

#endif
