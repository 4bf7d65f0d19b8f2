/* SPDX-License-Identifier: MIT
 *
 * Blocks of 8^3 voxels, as what reads and writes whole maps has them: drawing, hulls, files of others.
 *
 *   order   cells are in the order of keys: of the nine bits of an index the lowest is x, then y, z, x, y, z, x, y, z
 *   corner  of a cube or a block, in finest voxels from the root's centre: a multiple of its length
 */
#ifndef MODULES_OCTREE_BLOCK_ACCESS_H
#define MODULES_OCTREE_BLOCK_ACCESS_H

#include <stdint.h>

#include <cubemap/octree.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CM_BLOCK_EDGE 8
#define CM_BLOCK_CELLS 512

/* What is known of a block, one value a voxel of level 0. Colours are 0 where there is none; color NULL: none at all. */
typedef struct cm_block_values
{
    int64_t corner[3];
    int detail; /* its cells are of 2^detail voxels each way, all alike within */
    const uint8_t *alpha;
    const uint8_t (*color)[3];
} cm_block_values;

/* What is not 0 ends the walk with CM_ERROR_STOPPED. */
typedef int (*cm_block_job)(void *user, const cm_block_values *block);

/* All blocks that have an occupied voxel, in the order of keys. */
cm_status cm_octree_occupied_blocks(const cm_octree *octree, cm_block_job job, void *user);

/* All voxels of a cube of 2^level voxels, 3 or more, take a value. For maps that were made empty. */
cm_status cm_octree_set_cube(cm_octree *octree, const int64_t corner[3], int level, uint8_t alpha);

/* The voxels of a block take these. color may be NULL. */
cm_status cm_octree_set_block(cm_octree *octree, const int64_t corner[3], const uint8_t alpha[512],
                              const uint8_t (*color)[3]);

/* 1 while no voxel is known. */
int cm_octree_is_empty(const cm_octree *octree);

#ifdef __cplusplus
}
#endif

#endif
