/* SPDX-License-Identifier: MIT
 *
 * The kernels as inline functions for C and C++, each once in double (names end in _f64) and once in
 * float (_f32): for programs that want a mapping inside their own loops. No library to link.
 *
 *     cm_constants_f32 k = cm_algebraic_prepare_f32(cm_make_parameters_f32(0.87f, 0.0f));
 *     cm_uv_f32 uv = cm_algebraic_forward_f32(p, q, k);
 *
 * The parameters are those of the descriptor, in its order.
 *
 * A mapping called M has cm_M_prepare, and if it warps a face cm_M_forward (p, q to u, v) and
 * cm_M_inverse; if it maps directions itself (healpix, rhealpix, octahedral, clarberg) cm_M_project (direction to face, u,
 * v) and cm_M_unproject instead. All take the prepared constants last. cm_cube_project and cm_cube_unproject go between directions and (p, q), in
 * the frame geo.
 *
 * Derivatives: cm_M_jacobian takes a point as (p, q) and as the (u, v) that cm_M_forward makes of it, and
 * gives those of (u, v) by (p, q); cm_cube_tangents and cm_cube_gradients give those of the unit direction
 * by (p, q) and of (p, q) by the direction, cm_jacobian_tangents and cm_jacobian_gradients make of both
 * those by and of (u, v). For a map of directions they are cm_M_tangents and cm_M_gradients. Where a map has a crease
 * they are those of the side to which the point counts.
 *
 * Arguments must be inside their ranges: [-1, 1] for coordinates, a finite non-zero
 * direction; nothing is checked. The bounds on error that docs/guide/mappings.md gives hold if the
 * compiler keeps IEEE arithmetic; under -ffast-math, in float, the edges of a face are no longer exact
 * for every mapping.
 *
 * For GLSL include <cubemap/kernel/backend.h>.
 */
#ifndef CUBEMAP_KERNELS_H
#define CUBEMAP_KERNELS_H

#include <math.h>

#define CM_BACKEND 1
#include "kernel/backend.h"
#undef CM_BACKEND
#define CM_BACKEND 2
#include "kernel/backend.h"
#undef CM_BACKEND
#include "kernel/undefine.h"

#endif
