/* SPDX-License-Identifier: MIT
 *
 * x86-64 as it is.
 */
#define CM_SET sse2
#include "camera_set.inc"
