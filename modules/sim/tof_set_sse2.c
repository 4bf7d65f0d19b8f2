/* SPDX-License-Identifier: MIT
 *
 * x86-64.
 */
#define CM_SET sse2
#define CM_SET_IS_SCALAR 0
#include "tof_set.inc"
