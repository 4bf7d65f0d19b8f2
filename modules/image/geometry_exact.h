/* SPDX-License-Identifier: MIT
 *
 * Blocks whose pixels are placed one by one.
 */
#ifndef MODULES_IMAGE_GEOMETRY_EXACT_H
#define MODULES_IMAGE_GEOMETRY_EXACT_H

#include "group.h"
#include "resample_plan.h"

/* Pixels of a block that the target's plane has. */
typedef struct cm_exact_places
{
    unsigned plane;
    unsigned count;
    uint8_t pixel[CM_BLOCK_PIXELS];
    double column[CM_BLOCK_PIXELS];
    double row[CM_BLOCK_PIXELS];
    uint8_t found[CM_BLOCK_PIXELS];
    double x[CM_BLOCK_PIXELS];
    double y[CM_BLOCK_PIXELS];
} cm_exact_places;

/* As cm_geometry_block, for any block. */
unsigned cm_exact_block(const cm_plan *plan, int derivatives, unsigned plane, uint32_t block_column,
                        uint32_t block_row, cm_group *groups);

/* Derivatives of the places of groups that have been made of them; group_of is each place's, or CM_NO_FACE. */
void cm_exact_slopes(const cm_plan *plan, const cm_exact_places *at, const uint8_t *group_of,
                     cm_group *groups);

#endif
