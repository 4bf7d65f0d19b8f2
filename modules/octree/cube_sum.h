/* SPDX-License-Identifier: MIT
 *
 * Averages over cubes, of alphas and of the colors of what is occupied: what inner nodes have.
 */
#ifndef MODULES_OCTREE_CUBE_SUM_H
#define MODULES_OCTREE_CUBE_SUM_H

#include "octree_object.h"

/* Large cubes are counted apart, in units of their voxels: all of a root have 2^60, of which 64 bits hold no 127. */
#define CM_LARGE_LEVEL 10

/* To begin with zeros. Alphas less 127, of what is free and of what is occupied apart, so that sums are not negative. */
typedef struct cm_cube_sum
{
    uint64_t above;
    uint64_t below;
    uint64_t large_above; /* times 2^(3 CM_LARGE_LEVEL) */
    uint64_t large_below;
    uint64_t color[3]; /* of occupied voxels that have one, weighted by them */
    uint64_t colored;
} cm_cube_sum;

/* A cube of 2^level voxels each way of an alpha, without a color. */
void cm_cube_add(cm_cube_sum *sum, uint8_t alpha, int level);

/* Voxels of a block, from a first one on, in the order of keys; cells are of that detail. */
void cm_cube_add_cells(cm_cube_sum *sum, const uint8_t alpha[512], const uint32_t color[512],
                       unsigned detail, unsigned first, unsigned count);

/* Is any of them occupied? Then the cube is. */
static inline int cm_cube_is_occupied(const cm_cube_sum *sum)
{
    return sum->above > 0 || sum->large_above > 0;
}

/* The voxel of a level. Its alpha is rounded to the nearest; halves go away from 127, which is that of nothing known. Where
 * anything is occupied what is free counts as 127, and the least is 128. */
cm_voxel cm_cube_voxel(const cm_octree *octree, const cm_cube_sum *sum, const uint32_t place[3],
                       int level);

#endif
