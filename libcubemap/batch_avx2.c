/* SPDX-License-Identifier: MIT
 *
 * x86-64 with AVX2 and FMA; the build gives this file the flags.
 */
#include <immintrin.h>

#define CM_LANES "lanes/avx2.h"
#define CM_SET avx2
#include "batch_set.h"
