/* SPDX-License-Identifier: MIT
 *
 * What whoever computes with hues in degrees, or with XYZ, needs.
 */
#ifndef COLORMAP_COLOR_SPACES_H
#define COLORMAP_COLOR_SPACES_H

#define CM_COLORMAP_PI 3.14159265358979323846264338327950288

/* The white of sRGB, x = 0.3127, y = 0.3290, with Y = 1. */
#define CM_COLORMAP_WHITE_X (0.3127 / 0.3290)
#define CM_COLORMAP_WHITE_Z (0.3583 / 0.3290)

/* Y = 1 for white. The result may overwrite the argument. */
void cm_colormap_xyz_from_linear(const double linear[3], double xyz[3]);
void cm_colormap_linear_from_xyz(const double xyz[3], double linear[3]);

/* The product of a matrix and a vector, which may be one place. */
void cm_colormap_multiply(const double matrix[3][3], const double vector[3], double result[3]);

#endif
