/* SPDX-License-Identifier: MIT
 *
 * x86-64 with AVX2 and FMA; the build gives this file the flags.
 */
#include <immintrin.h>

#define CM_LANES "libcubemap/batch/lanes/avx2.inc"
#define CM_SET avx2
#include "set.inc"
