/* SPDX-License-Identifier: MIT
 *
 * AArch64.
 */
#include <arm_neon.h>

#define CM_FOUR "four_neon.inc"
#define CM_BYTES "bytes_neon.inc"
#define CM_SET neon
#include "sample_set.inc"
