/* SPDX-License-Identifier: MIT
 *
 * Regions, as coverings ask them.
 */
#ifndef LIBCUBEMAP_CELLS_REGION_H
#define LIBCUBEMAP_CELLS_REGION_H

#include <cubemap/covering.h>

/* How a cap lies to a region. */
typedef enum cm_lie
{
    CM_LIE_OUT, /* they have nothing in common */
    CM_LIE_PART,
    CM_LIE_IN /* all of it is in the region */
} cm_lie;

/* PART may be wrong, by little; the others are certain. normal has length 1. *has_middle: is the cap's middle
 * in the region? */
cm_lie cm_region_lie(const cm_region *region, const double normal[3], double radius,
                     int *has_middle);

#endif
