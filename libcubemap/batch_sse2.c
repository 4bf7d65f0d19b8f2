/* SPDX-License-Identifier: MIT
 *
 * Baseline x86-64.
 */
#include <emmintrin.h>

#define CM_LANES "lanes/sse2.h"
#define CM_SET sse2
#include "batch_set.h"
