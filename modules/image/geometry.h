/* SPDX-License-Identifier: MIT
 *
 * Where the pixels of a target's blocks lie on the source. Blocks stand on a grid of the target's planes that does
 * not depend on what part of it is wanted, and a block is always computed as a whole: so any part has the bits of the
 * whole.
 */
#ifndef MODULES_IMAGE_GEOMETRY_H
#define MODULES_IMAGE_GEOMETRY_H

#include "group.h"
#include "resample_plan.h"

/* What a thread keeps from block to block of a row. */
typedef struct cm_geometry cm_geometry;

/* NULL if there is no memory. Derivatives are made if they are wanted. */
cm_geometry *cm_geometry_create(const cm_plan *plan, int derivatives);
void cm_geometry_destroy(cm_geometry *geometry);

/* The groups of a block, at most CM_GROUPS_MAX: those of pixels that the target's plane has, each in one. What the
 * source does not show is in none. Places are as exact as the plan's tolerance, and may be beyond the plane by so
 * much, but not by more than a quarter of a pixel. Blocks are taken along rows, and rows downwards, for speed, but
 * may come in any order: bits do not depend on it. Returns how many groups there are. */
unsigned cm_geometry_block(cm_geometry *geometry, unsigned plane, uint32_t block_column,
                           uint32_t block_row, cm_group *groups);

/* How many blocks have been asked for, and how they were made. */
typedef struct cm_geometry_count
{
    uint64_t interpolated;
    uint64_t exact;
} cm_geometry_count;

cm_geometry_count cm_geometry_counted(const cm_geometry *geometry);

#endif
