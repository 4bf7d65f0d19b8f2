/* SPDX-License-Identifier: MIT */
#include "in_double.inc"

#define FORWARD cm_forward
#define INVERSE cm_inverse
#define WARP cm_warp
#define UNWARP cm_unwarp
#include "fuzz_points.inc"
