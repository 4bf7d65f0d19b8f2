/* SPDX-License-Identifier: MIT
 *
 * Baseline x86-64.
 */
/* what of it there is, the flags of the build say (-march=native) */
#include <immintrin.h>

#define CM_LANES "libcubemap/batch/lanes/sse2.inc"
#define CM_SET sse2
#include "set.inc"
