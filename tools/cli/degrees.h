/* SPDX-License-Identifier: MIT
 *
 * Directions from longitude and latitude in degrees, and back. Going through radians would lose
 * what degrees have: 90 is exact, pi/2 is not. Here every multiple of 90 degrees gives the axis
 * exactly, and back, and a result is rounded once at its end.
 */
#ifndef CUBEMAP_TOOLS_DEGREES_H
#define CUBEMAP_TOOLS_DEGREES_H

#ifdef __cplusplus
extern "C" {
#endif

/* Sine and cosine of any finite angle in degrees, which is reduced exactly; two NaN for others.
 * Both are within 0.8 ulp (1 ulp where the result is below 2^-120), exact at multiples of 90 and equal
 * in magnitude at odd multiples of 45. */
void degrees_sine_cosine(double degrees, double *sine, double *cosine);

/* atan2 in degrees, in [-180, 180]: exact on the axes and diagonals; elsewhere within 1.5 ulp of
 * the result, 1 ulp above 45 degrees and 0.75 ulp above 90 (measured with glibc), 2 ulp below 2^-120
 * degrees, and below 1e-306 degrees to an ulp of the subnormal radians. A y of -0 counts
 * as +0, so that the direction opposite to x is always at +180. */
double degrees_atan2(double y, double x);

/* The unit direction of any finite longitude and of a latitude in [-90, 90]: exactly an axis at
 * multiples of 90, exactly (0, 0, +-1) at a pole for every longitude. Three NaN for others. */
void degrees_to_direction(double longitude, double latitude, double direction[3]);

/* Longitude in [-180, 180] and latitude in [-90, 90] of a direction of any finite length that is
 * not zero; at a pole the longitude is 0. Two NaN for others. */
void degrees_from_direction(const double direction[3], double *longitude, double *latitude);

#ifdef __cplusplus
}
#endif

#endif
