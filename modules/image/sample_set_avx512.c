/* SPDX-License-Identifier: MIT
 *
 * x86-64 with AVX-512 F, DQ, BW and VL; the build gives this file the flags.
 */
#include <immintrin.h>

#define CM_FOUR "four_x86.inc"
#define CM_BYTES "bytes_x86.inc"
#define CM_WIDE "taps_x86.inc"
#define CM_SET avx512
#include "sample_set.inc"
