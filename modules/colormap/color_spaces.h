/* SPDX-License-Identifier: MIT
 *
 * What whoever computes with hues in degrees needs.
 */
#ifndef COLORMAP_COLOR_SPACES_H
#define COLORMAP_COLOR_SPACES_H

#define CM_COLORMAP_PI 3.14159265358979323846264338327950288

#endif
