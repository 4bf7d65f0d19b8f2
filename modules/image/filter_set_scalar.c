/* SPDX-License-Identifier: MIT
 *
 * Any processor, in plain C.
 */
#define CM_SET scalar
#include "filter_set.inc"
