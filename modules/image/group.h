/* SPDX-License-Identifier: MIT
 *
 * Pixels of a block of the target that lie together on a plane of the source.
 */
#ifndef MODULES_IMAGE_GROUP_H
#define MODULES_IMAGE_GROUP_H

#include "place_set.h"
#include "surface_object.h"

#define CM_BLOCK_PIXELS (CM_BLOCK_EDGE * CM_BLOCK_EDGE)

/* A block has no more groups: one for each plane of the source, or three where its columns come again. */
#define CM_GROUPS_MAX CM_PLANES_MAX

/* Pixels of a block that lie on one plane of the source, and where its columns come again, at one end of it. Places are
 * from the origin, in source pixels, so that the centre of the source's pixel (column, row) is at (0, 0). */
typedef struct cm_group
{
    float x[CM_BLOCK_PIXELS];
    float y[CM_BLOCK_PIXELS];
    float by_column
        [2]
        [CM_BLOCK_PIXELS]; /* derivatives of x and y by the target's column, in pixels, if wanted */
    float by_row[2][CM_BLOCK_PIXELS];
    uint8_t own_pixel[CM_BLOCK_PIXELS]; /* what `pixel` is unless it is all of the block */
    const uint8_t *pixel;               /* which of the block, by rows of CM_BLOCK_EDGE; growing */
    uint8_t plane;                      /* of the source */
    unsigned count;                     /* pixels */
    int32_t column;                     /* the origin, a pixel of the plane */
    int32_t row;
    int is_bounded; /* are the bounds below known? */
    int is_tight;   /* are they those of places? */
    float low[2];   /* no x and y is less, and the truth may be more */
    float high[2];
} cm_group;

/* A group without pixels, of which the origin is near (x, y). */
static inline void cm_group_begin(cm_group *group, uint8_t plane, double x, double y)
{
    group->plane = plane;
    group->count = 0;
    group->pixel = group->own_pixel;
    group->is_bounded = 0;
    group->is_tight = 0;
    group->column = (int32_t)x;
    group->row = (int32_t)y;
}

#endif
