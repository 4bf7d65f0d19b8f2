/* SPDX-License-Identifier: MIT
 *
 * x86-64 as it began.
 */
#define CM_SET sse2
#include "filter_set.inc"
