/* SPDX-License-Identifier: MIT */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/batch/mapping_object.h"
#include "parts.h"

#define CM_BACKEND 2
#define CM_PUBLIC(name) name##_f32
#include "parts.inc"
#include "points.inc"
