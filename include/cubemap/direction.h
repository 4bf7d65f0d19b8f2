/* SPDX-License-Identifier: MIT
 *
 * Directions and lon/lat. Directions are primary; lon/lat are thin wrappers.
 *
 * x = cos lat cos lon, y = cos lat sin lon, z = sin lat. Radians.
 */
#ifndef CUBEMAP_DIRECTION_H
#define CUBEMAP_DIRECTION_H

#include <cubemap/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The unit direction of a longitude (any finite number) and a latitude in [-pi/2, pi/2], up to 1e-9
 * beyond which is taken as the pole. Anything else gives three NaN. Error: 2 ulp of 1 in each
 * component beyond what the arguments' own rounding makes (lat = (double)(pi/2) is 6.1e-17 short of
 * the pole, and so is its direction). Cost: two sincos of the C library. */
CM_API void cm_direction_from_lonlat(double lon, double lat, double direction[3]);

/* lonlat[0] in [-pi, pi] and lonlat[1] in [-pi/2, pi/2] of a direction of any finite length that is
 * not zero; anything else gives two NaN. Accurate to 2 ulp everywhere, the poles included: the
 * latitude comes from atan2(z, hypot(x, y)), not from an arc sine. At a pole lon is 0 or +-pi by the
 * signs of x and y, as atan2 has it. Cost: two atan2 and a square root. */
CM_API void cm_lonlat_from_direction(const double direction[3], double lonlat[2]);

#ifdef __cplusplus
}
#endif

#endif
