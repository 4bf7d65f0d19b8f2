/* SPDX-License-Identifier: MIT
 *
 * On which side of a plane through the camera's centre a ray lies, exactly.
 */
#ifndef MODULES_SCENE_EXACT_SIDE_H
#define MODULES_SCENE_EXACT_SIDE_H

/* The sign of det(ray, p, q), 1 or -1. Where that is 0, the sign of det(ray + (e, e^2, e^3), p, q) with a vanishing e > 0:
 * of a perspective camera the top-left rule, since a left edge has what is right of it inside. 0 if p and q are parallel.
 * Numbers are 0 or between 2^-220 and 2^220 in size, so that nothing under- or overflows. */
int cm_exact_side(const double ray[3], const double p[3], const double q[3]);

#endif
