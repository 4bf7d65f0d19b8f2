/* SPDX-License-Identifier: MIT
 *
 * Voxels that the ray of a pixel ends in, while the pixel that their centre falls on does not say so: rays meet them in a corner, at
 * silhouettes, on what is steep to the ray and at the picture's border. They are hit by the pixel whose ray ends in them.
 */
#ifndef MODULES_OCTREE_RAY_ENDS_H
#define MODULES_OCTREE_RAY_ENDS_H

#include "view_table.h"

/* A voxel by its Morton key in the tree, and the pixel, as an index of rules. */
typedef struct cm_ray_end
{
    uint64_t key;
    uint64_t pixel;
} cm_ray_end;

/* Some of a list, in the order of keys. */
typedef struct cm_ray_ends
{
    const cm_ray_end *first;
    const cm_ray_end *end;
} cm_ray_ends;

/* The ends of a view whose rules are there, each voxel once, with the first pixel in rows; they are the desk's. */
cm_status cm_ray_ends_find(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                           cm_pool *pool, cm_ray_ends *ends);

/* Ends as they were found, in any order: into the order of keys, each voxel once, with its first pixel. They stay in the list, which
 * has room for more: twice as many are sorted faster. */
cm_ray_ends cm_ray_ends_sort(cm_ray_end *list, size_t found, size_t room);

/* Those in a cube of 2^level voxels at a place. */
cm_ray_ends cm_ray_ends_in(cm_ray_ends ends, const uint32_t place[3], int level);

/* Of those in a region: those in a block, which are taken from them. Blocks are asked in the order of their numbers. */
cm_ray_ends cm_ray_ends_take_block(cm_ray_ends *ends, unsigned block);

/* What rays end in, of one block of finest voxels, is hit by their pixels, where it is not by its own. */
void cm_ray_ends_hit(cm_ray_ends ends, uint64_t hits[8], int32_t pixel[8][64]);

#endif
