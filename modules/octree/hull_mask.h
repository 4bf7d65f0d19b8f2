/* SPDX-License-Identifier: MIT
 *
 * Masks of hulls: which pixels are inside, and how many of each square.
 */
#ifndef MODULES_OCTREE_HULL_MASK_H
#define MODULES_OCTREE_HULL_MASK_H

#include <cubemap/octree.h>

#include "hull_set.h"

typedef enum cm_hull_class
{
    CM_HULL_OUTSIDE = 0, /* all voxels of a cube are outside of the mask */
    CM_HULL_INSIDE = 1,  /* all are inside */
    CM_HULL_MIXED = 2    /* nothing is known */
} cm_hull_class;

typedef struct cm_hull_mask
{
    const cm_view *view;
    const cm_camera_options *lens;
    const cm_octree_options *map;
    int outside_survives;
    int is_plain;   /* perspective without distortion: `table` is used, and cubes have classes */
    uint32_t *bits; /* with a row above and below, and a word before each row */
    size_t stride;
    uint32_t
        *sums; /* of pixels inside, of squares of CM_HULL_SQUARE pixels above and to the left */
    size_t squares[2]; /* how many there are in a row and in a column, and one more */
    cm_hull_table table;
} cm_hull_mask;

#define CM_HULL_SQUARE 4

/* CM_OK; CM_ERROR_MEMORY. What was made is to be dropped, whatever is returned. */
cm_status cm_hull_mask_make(const cm_view *view, const cm_octree_options *map, int outside_survives,
                            cm_hull_mask *mask);
void cm_hull_mask_drop(cm_hull_mask *mask);

/* Of voxel centres in a cube: its middle and half of what is from the first to the last of them. */
cm_hull_class cm_hull_classify(const cm_hull_mask *mask, const double middle[3], double half);

/* Of a block with a corner, in voxels from the root's centre, what is alive stays so if the mask has it. */
void cm_hull_carve_block(const cm_hull_mask *mask, const cm_hull_set *set, const int64_t corner[3],
                         uint64_t alive[8]);

#endif
