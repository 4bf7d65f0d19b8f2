/* SPDX-License-Identifier: MIT
 *
 * The loop of hulls over the voxels of a block, once for each instruction set.
 */
#ifndef MODULES_OCTREE_HULL_SET_H
#define MODULES_OCTREE_HULL_SET_H

#include <stdint.h>

/* A mask behind a perspective camera without distortion. */
typedef struct cm_hull_table
{
    const uint32_t *bits; /* of pixels, the lowest first; rows begin at words */
    int32_t stride;       /* words of a row */
    float width;
    float height;
    float focal[2];
    float centre[2]; /* columns and rows count from the centre of the first pixel */
    int outside_survives;
    float x[512]; /* of a block's voxels from its first, in the camera's axes */
    float y[512];
    float z[512];
} cm_hull_table;

typedef struct cm_hull_set
{
    const char *name; /* first: as in options.h */
    /* Of those voxels of a block that are alive, alive ones stay. first is where its first voxel is in the camera's axes, and z
     * of all is above 0. Sets bits in doubtful of those that are nearer than margin, in pixels, to the border of two pixels: what
     * alive says of them is nothing. */
    void (*carve)(const cm_hull_table *table, const float first[3], float margin, uint64_t alive[8],
                  uint64_t doubtful[8]);
} cm_hull_set;

extern const cm_hull_set cm_hull_scalar;
#ifdef CM_HAVE_SSE2
extern const cm_hull_set cm_hull_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const cm_hull_set cm_hull_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const cm_hull_set cm_hull_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const cm_hull_set cm_hull_neon;
#endif

/* The set of that name, the scalar one if this build has none. */
const cm_hull_set *cm_hull_set_find(const char *name);

#endif
