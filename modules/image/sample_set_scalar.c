/* SPDX-License-Identifier: MIT
 *
 * Any processor, in plain C.
 */
#define CM_FOUR "four_plain.inc"
#define CM_SET scalar
#include "sample_set.inc"
