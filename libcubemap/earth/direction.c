/* SPDX-License-Identifier: MIT
 *
 * Longitude and latitude of one point alone. The C library's functions raise nothing but inexact for easy numbers, so that
 * nothing must wait for the flags.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/mapping/exception_flags.h"

#include <math.h>
#include <string.h>

#define CM_BACKEND 1
#define CM_LANES_BITS 64
#define LONE_IS_EASY direction_is_easy
#define LONE_ARE_EASY direction_are_easy
#include <cubemap/kernel/dialect.h>

#include "libcubemap/batch/lone_easy.inc"
#undef CM_BACKEND
#undef CM_LANES_BITS
#undef LONE_IS_EASY
#undef LONE_ARE_EASY

static const double half_pi = 1.5707963267948966;

static void direction_of(double lon, double lat, double direction[3])
{
    double height = fabs(lat) > half_pi ? copysign(half_pi, lat) : lat;
    if (!isfinite(lon) || !(fabs(lat) <= half_pi + 1e-9))
    {
        direction[0] = direction[1] = direction[2] = (double)NAN;
        return;
    }
    double radius = cos(height);
    direction[0] = radius * cos(lon);
    direction[1] = radius * sin(lon);
    direction[2] = sin(height);
}

static void lonlat_of(const double direction[3], double lonlat[2])
{
    double magnitude = cm_magnitude_f64(direction[0], direction[1], direction[2]);
    if (!(magnitude > 0.0) || !isfinite(direction[0]) || !isfinite(direction[1]) ||
        !isfinite(direction[2]))
    {
        lonlat[0] = lonlat[1] = (double)NAN;
        return;
    }
    /* scaled by a power of two, so that hypot neither overflows nor loses subnormals */
    int exponent;
    frexp(magnitude, &exponent);
    double x = ldexp(direction[0], -exponent);
    double y = ldexp(direction[1], -exponent);
    double z = ldexp(direction[2], -exponent);
    lonlat[0] = atan2(direction[1], direction[0]);
    lonlat[1] = atan2(z, hypot(x, y));
}

void cm_direction_from_lonlat(double lon, double lat, double direction[3])
{
    if (direction_is_easy(lon, LONE_EASY_MOST) && direction_is_easy(lat, LONE_EASY_MOST))
    {
        direction_of(lon, lat, direction);
        return;
    }
    const cm_exceptions held = cm_exceptions_hold();
    direction_of(lon, lat, direction);
    cm_exceptions_restore(held);
}

void cm_lonlat_from_direction(const double direction[3], double lonlat[2])
{
    if (direction_are_easy(direction))
    {
        lonlat_of(direction, lonlat);
        return;
    }
    const cm_exceptions held = cm_exceptions_hold();
    lonlat_of(direction, lonlat);
    cm_exceptions_restore(held);
}
