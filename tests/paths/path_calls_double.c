/* SPDX-License-Identifier: MIT */
#define REAL double
#define REAL_NAME "double"
#define PUBLIC(name) name
#define TABLE paths_double
#define EPS 0x1p-53
#define LEAST 1e-300
#include "path_calls.inc"
