/* SPDX-License-Identifier: MIT
 *
 * x86-64 with AVX-512; the build gives this file the flags.
 */
#include <immintrin.h>

#define CM_LANES "libcubemap/batch/lanes/avx512.inc"
#define CM_SET avx512
#include "set.inc"
