/* SPDX-License-Identifier: MIT
 *
 * 64-bit Arm.
 */
#define CM_SET neon
#include "camera_set.inc"
