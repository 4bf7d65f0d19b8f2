/* SPDX-License-Identifier: MIT
 *
 * Conversions of the tests' own, which judge those of the library: from the chromaticities of the primaries of sRGB.
 */
#ifndef TESTS_OWN_COLORS_H
#define TESTS_OWN_COLORS_H

#define PI 3.14159265358979323846

/* XYZ from linear sRGB, with Y = 1 for white. */
void derive_matrix(double matrix[3][3]);

/* From sRGB in [0, 1]. */
void own_luv(const double srgb[3], double luv[3]);
void own_lab(const double srgb[3], double lab[3]);
void own_ucs(const double srgb[3], double ucs[3]);

double own_ciede2000(const double one[3], const double other[3]);

double distance(const double a[3], const double b[3]);

#endif
