/* SPDX-License-Identifier: MIT
 *
 * One pixel alone: AArch64.
 */
#include <arm_neon.h>

#define CM_LANES "libcubemap/batch/lanes/neon.inc"
#define CM_SET neon
#include "lone.inc"
