/* SPDX-License-Identifier: MIT
 *
 * What a ray meets in an analytic world, in quadruple precision where the compiler has it (gcc and clang on x86, AArch64),
 * by the textbook's formula for each flat or round piece alone: other formulas than the library's.
 */
#ifndef TRUTH_RAY_TRUTH_H
#define TRUTH_RAY_TRUTH_H

#include <cubemap/world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The distance in lengths of the direction, infinite for none, and the id of what is met. Meshes are gone through triangle
 * by triangle (Möller and Trumbore 1997). The second distance, if it is not NULL, is that of the next piece behind it. */
double ray_truth(const cm_scene *scene, const double origin[3], const double direction[3],
                 uint32_t *id, double *next);

#ifdef __cplusplus
}
#endif

#endif
