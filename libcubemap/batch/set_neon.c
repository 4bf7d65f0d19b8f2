/* SPDX-License-Identifier: MIT
 *
 * AArch64.
 */
#include <arm_neon.h>

#define CM_LANES "libcubemap/batch/lanes/neon.inc"
#define CM_SET neon
#include "set.inc"
