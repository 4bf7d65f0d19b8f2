/* SPDX-License-Identifier: MIT
 *
 * Angles, and products of vectors.
 */
#ifndef CUBEMAP_SIM_VECTOR_H
#define CUBEMAP_SIM_VECTOR_H

#include <math.h>

#define PI 3.14159265358979323846

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const double a[3], const double b[3], double product[3])
{
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

/* A vector of length 1 across an axis of that length: Duff and others 2017, "Building an orthonormal basis, revisited". */
static inline void find_across(const double axis[3], double across[3])
{
    const double sign = copysign(1.0, axis[2]);
    const double a = -1.0 / (sign + axis[2]);
    across[0] = 1.0 + sign * axis[0] * axis[0] * a;
    across[1] = sign * axis[0] * axis[1] * a;
    across[2] = -sign * axis[0];
}

/* Radians; NaN for a vector of no length. atan2 is exact for small angles, where the cosine is not. */
static inline double angle_between(const double a[3], const double b[3])
{
    double across[3];
    cross(a, b, across);
    const double sine = sqrt(dot(across, across)), cosine = dot(a, b);
    return sine == 0.0 && cosine == 0.0 ? (double)NAN : atan2(sine, cosine);
}

#endif
