/* SPDX-License-Identifier: MIT
 *
 * Rays by an index: in one step over all blocks around one that are empty, and from bit to bit in the others.
 */
#ifndef MODULES_OCTREE_INDEXED_RAY_H
#define MODULES_OCTREE_INDEXED_RAY_H

#include "ray_index.h"

/* A ray in voxels of the tree. */
/* 1 / step along an axis that a ray stands still on, or nearly: the border ahead is beyond all ends. */
#define CM_RAY_STANDS 1e300

typedef struct cm_ray_line
{
    double origin[3];
    double step[3]; /* voxels for a unit of the world */
    double by[3];   /* 1 / step */
    double at;      /* where it is, in units of the world */
    double end;
    int32_t place[3]; /* the voxel that it is in */
} cm_ray_line;

/* The box of an index in voxels [first, beyond), as far as it is the map's. */
void cm_ray_index_box(const cm_octree *octree, const cm_ray_index *index, uint32_t first[3],
                      uint32_t beyond[3]);

/* From a place in that box on to the first voxel that is occupied, and its block. NULL: there is none. */
const cm_ray_block *cm_ray_index_cast(const cm_ray_index *index, cm_ray_line *line);

#endif
