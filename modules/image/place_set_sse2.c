/* SPDX-License-Identifier: MIT
 *
 * x86-64 as it is.
 */
#define CM_SET sse2
#include "place_set.inc"
