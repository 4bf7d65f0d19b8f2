/* SPDX-License-Identifier: MIT
 *
 * Any processor.
 */
#define CM_SET scalar
#include "place_set.inc"
