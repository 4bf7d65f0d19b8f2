/* SPDX-License-Identifier: MIT
 *
 * Angles in degrees.
 */
#ifndef LIBCUBEMAP_MAPPING_ANGLE_H
#define LIBCUBEMAP_MAPPING_ANGLE_H

/* Of any finite angle in degrees, which is reduced exactly, so that multiples of 90 give 0 and 1; else to
 * 2 eps. */
void cm_sine_cosine_degrees(double degrees, double *sine, double *cosine);

#endif
