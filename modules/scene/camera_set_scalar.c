/* SPDX-License-Identifier: MIT
 *
 * Any processor.
 */
#define CM_SET scalar
#include "camera_set.inc"
