/* SPDX-License-Identifier: MIT
 *
 * Where the pixels of a target's blocks lie on the source. Blocks stand on a grid of the target's planes that does
 * not depend on what part of it is wanted, and a block is always computed as a whole: so any part has the bits of the
 * whole.
 */
#ifndef MODULES_IMAGE_GEOMETRY_H
#define MODULES_IMAGE_GEOMETRY_H

#include "place_set.h"
#include "resample_plan.h"

#define CM_BLOCK_PIXELS (CM_BLOCK_EDGE * CM_BLOCK_EDGE)

/* A block has no more groups: one for each plane of the source, or three where its columns come again. */
#define CM_GROUPS_MAX CM_PLANES_MAX

/* Pixels of a block that lie on one plane of the source, and where its columns come again, at one end of it. Places are
 * from the origin, in source pixels, so that the centre of the source's pixel (column, row) is at (0, 0). */
typedef struct cm_group
{
    uint8_t plane;  /* of the source */
    unsigned count; /* pixels */
    int32_t column; /* the origin, a pixel of the plane */
    int32_t row;
    float x[CM_BLOCK_PIXELS];
    float y[CM_BLOCK_PIXELS];
    const uint8_t *pixel;               /* which of the block, by rows of CM_BLOCK_EDGE; growing */
    uint8_t own_pixel[CM_BLOCK_PIXELS]; /* what that is unless it is all of the block */
    float by_column
        [2]
        [CM_BLOCK_PIXELS]; /* derivatives of x and y by the target's column, in pixels, if wanted */
    float by_row[2][CM_BLOCK_PIXELS];
    int is_bounded; /* are the bounds below known? */
    float low[2];   /* no x and y is less, and the truth may be more */
    float high[2];
} cm_group;

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
