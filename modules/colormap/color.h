/* SPDX-License-Identifier: MIT
 *
 * What whoever computes with hues in degrees needs.
 */
#ifndef COLOR_H
#define COLOR_H

#define CM_COLORMAP_PI 3.14159265358979323846264338327950288

#endif
