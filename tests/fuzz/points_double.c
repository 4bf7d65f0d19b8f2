/* SPDX-License-Identifier: MIT */
#include "in_double.h"

#define FORWARD cm_forward
#define INVERSE cm_inverse
#define WARP cm_warp
#define UNWARP cm_unwarp
#include "points.h"
