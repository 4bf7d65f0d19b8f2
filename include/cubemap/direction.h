/* SPDX-License-Identifier: MIT
 *
 * Directions and lon/lat. Directions are primary; lon/lat are thin wrappers.
 *
 * x = cos lat cos lon, y = cos lat sin lon, z = sin lat. Radians. docs/measured/accuracy.md has the bounds.
 */
#ifndef CUBEMAP_DIRECTION_H
#define CUBEMAP_DIRECTION_H

#include <stddef.h>

#include <cubemap/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The unit direction of a longitude (any finite number) and a latitude in [-pi/2, pi/2], up to 1e-9
 * beyond which is taken as the pole. Anything else gives three NaN. (double)(pi/2) is a little short of the
 * pole, and so is its direction. */
CM_API void cm_direction_from_lonlat(double lon, double lat, double direction[3]);

/* lonlat[0] in [-pi, pi] and lonlat[1] in [-pi/2, pi/2] of a direction of any finite length that is
 * not zero; anything else gives two NaN. The latitude comes from atan2(z, hypot(x, y)), not from an arc
 * sine, so that it is accurate at the poles. There lon is 0 or +-pi by the signs of x and y, as atan2 has it. */
CM_API void cm_lonlat_from_direction(const double direction[3], double lonlat[2]);

/* n points in separate arrays of n elements each, by vectors: not the bits of the two functions above, which ask the C
 * library, but those of mapping.h's arrays in lon/lat, whatever n and the position. The instruction set is the one that the
 * environment variable CUBEMAP_INSTRUCTIONS names, if this machine has it, else the best. Arrays may be NULL if n is 0; an
 * output may be the same array as an input. */
CM_API void cm_direction_from_lonlat_array(size_t n, const double *lon, const double *lat,
                                           double *x, double *y, double *z);
CM_API void cm_lonlat_from_direction_array(size_t n, const double *x, const double *y,
                                           const double *z, double *lon, double *lat);

#ifdef __cplusplus
}
#endif

#endif
