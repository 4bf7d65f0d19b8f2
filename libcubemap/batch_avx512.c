/* SPDX-License-Identifier: MIT
 *
 * x86-64 with AVX-512; the build gives this file the flags.
 */
#include <immintrin.h>

#define CM_LANES "lanes/avx512.h"
#define CM_SET avx512
#include "batch_set.h"
