/* SPDX-License-Identifier: MIT
 *
 * Plain C once more, for builds whose size counts: what their sets leave out, compiled for size.
 */
#define CM_SET_WITHOUT_FLOAT
#define CM_SET_WITHOUT_MAPS
#define CM_SET small
#define cm_healpix_lone_small cm_healpix_lone_scalar
#include "set.inc"
