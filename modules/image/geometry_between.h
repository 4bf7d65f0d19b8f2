/* SPDX-License-Identifier: MIT
 *
 * Blocks between exact nodes: polynomials, where they are as exact as is asked.
 */
#ifndef MODULES_IMAGE_GEOMETRY_BETWEEN_H
#define MODULES_IMAGE_GEOMETRY_BETWEEN_H

#include "group.h"
#include "lattice.h"

/* What does not change from block to block. */
typedef struct cm_between
{
    const cm_plan *plan;
    const cm_place_set *set;
    int derivatives;
    int is_creased;
    cm_place_weights weights;
    cm_place_weights slopes; /* of weights, in pixels */
    cm_wide_weights wide;
    uint8_t all_pixels[CM_BLOCK_PIXELS]; /* 0, 1, ... */
} cm_between;

void cm_between_begin(const cm_plan *plan, const cm_place_set *set, int derivatives,
                      cm_between *between);

/* What has been found of a block. */
typedef enum cm_between_found
{
    CM_BETWEEN_NONE, /* it is to be done exactly */
    CM_BETWEEN_INSIDE,
    CM_BETWEEN_ANYWHERE /* its places may be beyond the source's plane */
} cm_between_found;

/* All pixels of a block as one group of which the bounds are known. slack is how far beyond its edges places are still the
 * plane's own. */
cm_between_found cm_between_block(const cm_between *between, const cm_lattice_view *view,
                                  int is_uniform, double slack, cm_group *group);

#endif
