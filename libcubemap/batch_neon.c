/* SPDX-License-Identifier: MIT
 *
 * AArch64.
 */
#include <arm_neon.h>

#define CM_LANES "lanes/neon.h"
#define CM_SET neon
#include "batch_set.h"
