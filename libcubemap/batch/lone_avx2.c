/* SPDX-License-Identifier: MIT
 *
 * One pixel alone: x86-64 with AVX2 and FMA; the build gives this file the flags.
 */
#include <immintrin.h>

#define CM_LANES "libcubemap/batch/lanes/narrow.inc"
#define CM_SET avx2
#include "lone.inc"
