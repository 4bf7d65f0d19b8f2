/* SPDX-License-Identifier: MIT */
#define REAL float
#define REAL_NAME "float"
#define PUBLIC(name) name##_f32
#define TABLE paths_float
#define EPS 0x1p-24
#define LEAST 1e-36
#include "path_calls.inc"
