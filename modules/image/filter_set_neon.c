/* SPDX-License-Identifier: MIT
 *
 * AArch64.
 */
#define CM_SET neon
#include "filter_set.inc"
