/* SPDX-License-Identifier: MIT
 *
 * One pixel alone: x86-64.
 */
#include <emmintrin.h>

#define CM_LANES "libcubemap/batch/lanes/sse2.inc"
#define CM_SET sse2
#include "lone.inc"
