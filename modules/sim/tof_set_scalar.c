/* SPDX-License-Identifier: MIT
 *
 * Plain C.
 */
#define CM_SET scalar
#define CM_SET_IS_SCALAR 1
#include "tof_set.inc"
