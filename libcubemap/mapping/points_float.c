/* SPDX-License-Identifier: MIT */
#include "internal.h"

#define CM_BACKEND 2
#define CM_PUBLIC(name) name##_f32
#include "parts.inc"
#include "points.inc"
