/* SPDX-License-Identifier: MIT
 *
 * All that a map has within a box, in the order of keys: what is of one alpha as a cube, else blocks.
 */
#ifndef MODULES_OCTREE_WALK_H
#define MODULES_OCTREE_WALK_H

#include "voxel_region.h"

/* Who is called; what is not 0 ends the walk with CM_ERROR_STOPPED. */
typedef struct cm_walk
{
    uint32_t first[3];  /* the box, in voxels of the tree */
    uint32_t beyond[3]; /* the first that are not in it */
    uint64_t since;     /* only what changed after this step */
    int only_solid;     /* 1: of regions only blocks that may have an occupied voxel */
    void *user;
    /* A cube of 2^level voxels with one alpha, which may reach beyond the box. */
    int (*even)(void *user, const uint32_t place[3], int level, uint8_t alpha);
    /* A block that is not even, and misses that wait above it. */
    int (*block)(void *user, const cm_region *region, unsigned block, unsigned misses);
} cm_walk;

/* The whole of the map. */
void cm_walk_all(const cm_octree *octree, cm_walk *walk);

cm_status cm_walk_run(const cm_octree *octree, const cm_walk *walk);

/* From voxels of the tree to the world, and which voxel a coordinate is in, as a number that may be beyond the tree. */
double cm_place_world(const cm_octree *octree, int axis, double place);
double cm_world_place(const cm_octree *octree, int axis, double world);

/* As cm_octree_at, which cannot say that pages fail. */
cm_status cm_look_at(const cm_octree *octree, const double point[3], int level, cm_voxel *found);

/* A voxel of 2^level edges at a place. */
cm_voxel cm_voxel_at(const cm_octree *octree, const uint32_t place[3], int level, uint8_t alpha,
                     uint32_t color);

/* Does a cube of 2^level voxels meet the box [first, beyond), and is it wholly in it? */
int cm_box_meets(const uint32_t first[3], const uint32_t beyond[3], const uint32_t place[3],
                 int level);
int cm_box_has(const uint32_t first[3], const uint32_t beyond[3], const uint32_t place[3],
               int level);

#endif
