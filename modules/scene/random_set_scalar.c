/* SPDX-License-Identifier: MIT
 *
 * Any processor, in plain C.
 */
#define CM_SET scalar
#define CM_SET_IS_SCALAR 1
#include "random_set.inc"
