/* SPDX-License-Identifier: MIT
 *
 * One pixel alone, in plain C: the reference.
 */
#define CM_SET scalar
#include "lone.inc"
