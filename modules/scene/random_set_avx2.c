/* SPDX-License-Identifier: MIT
 *
 * x86-64 with AVX2 and FMA; the build gives this file the flags.
 */
#define CM_SET avx2
#define CM_SET_IS_SCALAR 0
#include "random_set.inc"
