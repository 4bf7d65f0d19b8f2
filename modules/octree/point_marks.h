/* SPDX-License-Identifier: MIT
 *
 * Which voxels points hit and their rays miss: bits of blocks, which lie by region, so that each voxel has its own once however
 * many rays go through it.
 */
#ifndef MODULES_OCTREE_POINT_MARKS_H
#define MODULES_OCTREE_POINT_MARKS_H

#include "octree_object.h"

/* In the order of keys. */
typedef struct cm_block_marks
{
    uint64_t hits[8];
    uint64_t misses[8];
    uint32_t hit; /* the last of its hits; CM_NO_HIT: none */
} cm_block_marks;

/* The first hit of a voxel. */
typedef struct cm_point_hit
{
    uint32_t before; /* the one before it in its block; CM_NO_HIT: none */
    uint32_t cell;
} cm_point_hit;

#define CM_NO_HIT UINT32_MAX

typedef struct cm_region_marks
{
    uint32_t place[3]; /* of the region */
    int has_hits;
    uint32_t block[CM_REGION_BLOCKS]; /* which marks, and 1; 0: none */
} cm_region_marks;

/* Filled with zeros it is empty. */
typedef struct cm_point_marks
{
    cm_region_marks *region;
    size_t region_count;
    size_t region_room;
    uint32_t *slot; /* a table of regions, by place: which, and 1; 0: none */
    size_t slots;
    cm_block_marks *block;
    size_t block_count;
    size_t block_room;
    uint32_t
        last_place[3]; /* of the block that was hit last: points beside each other come together */
    uint32_t last;     /* which, and 1; 0: none */
    cm_point_hit *hit;
    uint32_t *color; /* of hits: words; NULL if no point has any */
    size_t hit_count;
    size_t hit_room;
} cm_point_marks;

void cm_marks_clear(cm_point_marks *marks);

/* The marks of a block of the region at a place, which are made if there are none; NULL if there is no memory. They stay where
 * they are until others are made. */
cm_block_marks *cm_marks_of(cm_point_marks *marks, const uint32_t place[3], unsigned block);

/* A point in a voxel; rgb may be NULL. 0 if there is no memory. */
int cm_marks_hit(cm_point_marks *marks, const uint32_t place[3], const uint8_t *rgb);

/* All voxels from one place of the tree to another, which are in the map, but not that of the end if is_before. 0 if there is no
 * memory. */
int cm_marks_ray(cm_point_marks *marks, const cm_octree *octree, const double from[3],
                 const double to[3], int is_before);

#endif
