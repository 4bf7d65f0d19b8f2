/* SPDX-License-Identifier: MIT
 *
 * Places of blocks from nodes that are far apart: where the sphere bends little, one polynomial has a patch of 4 x 4 blocks.
 */
#ifndef MODULES_IMAGE_PATCH_H
#define MODULES_IMAGE_PATCH_H

#include "lattice.h"

/* What is kept from block to block. */
typedef struct cm_patches cm_patches;

/* NULL if there is no memory. */
cm_patches *cm_patches_create(const cm_plan *plan, const cm_place_set *set);
void cm_patches_destroy(cm_patches *patches);

/* Places of a block's pixels on one plane of the source, from a pixel of it, the origin. */
typedef struct cm_patch_places
{
    uint8_t plane;
    int32_t column;
    int32_t row;
    float low[2]; /* of x and y */
    float high[2];
} cm_patch_places;

/* The places of a block, by rows, if its patch is as exact as the plan asks. Returns 0 if it is not. */
int cm_patches_block(cm_patches *patches, unsigned plane, uint32_t block_column, uint32_t block_row,
                     cm_patch_places *places, float *x, float *y);

/* Lagrange's weights of so many nodes for the pixels of a block, of which the first one's edge is that many nodes after the
 * first node, and their derivatives in pixels unless that is NULL. */
void cm_weigh_nodes(int nodes, double first, double per_pixel, float (*weights)[CM_BLOCK_EDGE],
                    float (*slopes)[CM_BLOCK_EDGE]);

#endif
