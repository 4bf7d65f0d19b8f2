/* SPDX-License-Identifier: MIT
 *
 * x86-64 as it began.
 */
#include <emmintrin.h>

#define CM_SET sse2
#define CM_WHOLE_SSE2 /* x86-64 has its words in the scalar set, too, which is to have none */
#include "filter_set.inc"
