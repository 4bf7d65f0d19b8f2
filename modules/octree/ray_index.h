/* SPDX-License-Identifier: MIT
 *
 * What rays ask of a map that stays as it is: how far around a block nothing is occupied, and which voxels of the others are. It is
 * made once many rays have gone through the map, and forgotten at its next change.
 *
 *   away      of each block in a box around all that is occupied: so many blocks in each direction, less one, have nothing. 0: its
 *             own may have
 *   number    of such a block among them, in the order of the box, x first
 *   values    of occupied voxels lie together, so that little memory is read
 */
#ifndef MODULES_OCTREE_RAY_INDEX_H
#define MODULES_OCTREE_RAY_INDEX_H

#include "seen_tree.h"
#include "voxel_region.h"

/* A block of the others. */
typedef struct cm_ray_block
{
    uint64_t mask[8];   /* its occupied voxels, as bits in the order of keys */
    uint32_t first;     /* value of the first */
    uint16_t before[8]; /* values of the words of the mask before */
    uint8_t level;      /* of its voxels; CM_RAY_BLOCK_EVEN: it is all occupied, without values */
} cm_ray_block;

#define CM_RAY_BLOCK_EVEN 255

typedef struct cm_ray_index
{
    int32_t first[3]; /* of the box, in blocks */
    int32_t count[3];
    uint8_t *away;    /* NULL: the map is too large for an index, or memory lacked */
    uint64_t *has;    /* bits of blocks: away is 0 */
    uint32_t *before; /* blocks with a bit in the words before */
    cm_ray_block *block;
    uint8_t *alpha; /* values of voxels: no misses wait */
    uint32_t *color;
} cm_ray_index;

/* The index of a map, or NULL while there is none. */
const cm_ray_index *cm_ray_index_of(const cm_octree *octree);

/* To be called before anything of the map changes. */
void cm_ray_index_forget(cm_octree *octree);

/* The number of a block, whose bit is 1. */
static inline size_t cm_ray_block_number(const cm_ray_index *index, size_t at)
{
    const uint64_t below = index->has[at / 64] & cm_bits_below((unsigned)(at % 64));
    return index->before[at / 64] + cm_bit_count(below);
}

#endif
