/* SPDX-License-Identifier: MIT
 *
 * x86-64 with AVX-512 F, DQ, BW and VL; the build gives this file the flags.
 */
#define CM_SET avx512
#define CM_SET_IS_SCALAR 0
#include "random_set.inc"
