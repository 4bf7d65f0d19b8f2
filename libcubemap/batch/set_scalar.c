/* SPDX-License-Identifier: MIT
 *
 * One point at a time, in plain C: the reference.
 */
#define CM_SET scalar
#include "set.inc"
