/* SPDX-License-Identifier: MIT
 *
 * One pixel alone: x86-64 with AVX-512; the build gives this file the flags.
 */
#include <immintrin.h>

#define CM_LANES "libcubemap/batch/lanes/narrow.inc"
#define CM_SET avx512
#include "lone.inc"
