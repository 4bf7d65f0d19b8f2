/* SPDX-License-Identifier: MIT
 *
 * The kernels as inline functions for C and C++, each once in double (names end in _f64) and once in float (_f32): for
 * programs that want a mapping inside their own loops. No library to link.
 *
 *     cm_constants_f32 k = cm_algebraic_prepare_f32(cm_make_parameters_f32(0.87f, 0.0f));
 *     cm_uv_f32 uv = cm_algebraic_forward_f32(p, q, k);
 *
 * A mapping called M has cm_M_prepare, which takes the descriptor's parameters in its order; if it warps a face
 * cm_M_forward (p, q to u, v), cm_M_inverse and cm_M_jacobian; if it maps directions itself (healpix, rhealpix,
 * octahedral, clarberg) cm_M_project (direction to face, u, v), cm_M_unproject, cm_M_tangents and cm_M_gradients. All
 * take the prepared constants last. cm_cube_project and cm_cube_unproject go between directions and (p, q), in the
 * frame geo. Where a map has a crease, derivatives are those of the side to which the point counts.
 *
 * Arguments must be inside their ranges, [-1, 1] for coordinates, a finite non-zero direction; nothing is checked.
 * Bounds hold if the compiler keeps IEEE arithmetic. Shaders: docs/guide/shaders.md.
 * docs/guide/conventions.md says more of derivatives.
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
