/* SPDX-License-Identifier: MIT */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/batch/mapping_object.h"
#include "parts.h"

#define CM_BACKEND 1
#define CM_PUBLIC(name) name
#include "parts.inc"
#include "points.inc"
