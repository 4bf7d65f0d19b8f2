/* SPDX-License-Identifier: MIT
 *
 * AArch64.
 */
#define CM_SET neon
#define CM_SET_IS_SCALAR 0
#include "random_set.inc"
