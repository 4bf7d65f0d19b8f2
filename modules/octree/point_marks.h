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
    uint32_t run; /* the last of its runs of hits, and 1; 0: none */
} cm_block_marks;

/* First hits of voxels of a block, one after the other, up to those of the next run. */
typedef struct cm_hit_run
{
    uint32_t first;
    uint32_t before; /* the run before it in its block, and 1; 0: none */
} cm_hit_run;

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
    uint32_t last_region; /* that was asked for last, and 1; 0: none */
    uint32_t *slot;       /* a table of regions, by place: which, and 1; 0: none */
    size_t slots;
    cm_block_marks *block;
    size_t block_count;
    size_t block_room;
    uint64_t
        last_place;  /* of the block that was hit last: points beside each other come together */
    uint32_t last;   /* which, and 1; 0: none */
    uint16_t *cell;  /* of hits with a color */
    uint32_t *color; /* words; NULL if no point has any */
    size_t hit_count;
    size_t hit_room;
    cm_hit_run *run;
    size_t run_count;
    size_t run_room;
} cm_point_marks;

void cm_marks_clear(cm_point_marks *marks);

/* The marks of a block of the region at a place, which are made if there are none; NULL if there is no memory. They stay where
 * they are until others are made. */
cm_block_marks *cm_marks_of(cm_point_marks *marks, const uint32_t place[3], unsigned block);

/* Points in voxels, as octree_set.h has them: those that bits are of. rgb may be NULL. 0 if there is no memory. */
int cm_marks_hits(cm_point_marks *marks, const uint64_t place[CM_POINTS_TOGETHER], uint64_t bits,
                  const uint8_t *rgb);

/* All voxels from one place of the tree to another, which are in the map, but not that of the end if is_before. 0 if there is no
 * memory. */
int cm_marks_ray(cm_point_marks *marks, const cm_octree *octree, const double from[3],
                 const double to[3], int is_before);

#endif
