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

/* Two vectors of length 1 across one of that length, and across each other. */
static inline void find_across(const double axis[3], double x[3], double y[3])
{
    const double away[3] = {fabs(axis[0]) < 0.6, fabs(axis[0]) >= 0.6, 0.0};
    cross(away, axis, x);
    const double length = sqrt(dot(x, x));
    for (int k = 0; k < 3; k++)
    {
        x[k] /= length;
    }
    cross(axis, x, y);
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
