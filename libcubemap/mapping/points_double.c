/* SPDX-License-Identifier: MIT */
#include "internal.h"

#define CM_BACKEND 1
#define CM_PUBLIC(name) name
#include "parts.inc"
#include "points.inc"
