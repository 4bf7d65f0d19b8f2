/* SPDX-License-Identifier: MIT
 *
 * x86-64 as it began.
 */
#define CM_SET sse2
#define CM_SET_IS_SCALAR 0
#include "random_set.inc"
