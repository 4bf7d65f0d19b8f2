/* SPDX-License-Identifier: MIT */
#include "in_float.inc"

#define FORWARD cm_forward_f32
#define INVERSE cm_inverse_f32
#define WARP cm_warp_f32
#define UNWARP cm_unwarp_f32
#include "fuzz_points.inc"
