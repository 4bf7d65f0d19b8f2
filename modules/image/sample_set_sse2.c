/* SPDX-License-Identifier: MIT
 *
 * x86-64 as it began.
 */
#include <immintrin.h>

#define CM_FOUR "four_x86.inc"
#define CM_SET sse2
#include "sample_set.inc"
