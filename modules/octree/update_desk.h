/* SPDX-License-Identifier: MIT
 *
 * One update at work.
 */
#ifndef MODULES_OCTREE_UPDATE_DESK_H
#define MODULES_OCTREE_UPDATE_DESK_H

#include <stdatomic.h>

#include "node_tree.h"
#include "ray_ends.h"
#include "view_table.h"

#define CM_DETAILS 4
#define CM_REGION_GROUPS (8 * CM_REGION_BLOCKS)

/* Kept from update to update: the memory of images and lists. */
typedef struct cm_update_desk
{
    cm_view_desk view;
    uint32_t *list; /* nodes of regions in which something may happen */
    size_t count;
    size_t room;
    uint32_t *missed; /* nodes of which all is missed */
    size_t missed_count;
    size_t missed_room;
    void *rounds; /* of cameras that are not straight: update_round.c */
    void (*rounds_destroy)(void *rounds);
} cm_update_desk;

/* What all regions of an update share. */
typedef struct cm_update
{
    cm_octree *octree;
    cm_update_desk *desk;
    const cm_view *view;
    const cm_octree_set *set;
    double step[3][3]; /* a finest edge along each axis of the world, in the camera's axes */
    double origin[3];  /* the centre of the first voxel of the tree, in the camera's axes */
    float block_half
        [3]; /* half a box along the camera's axes around the centres of a block's voxels */
    float eight_half[3]; /* of eight blocks */
    float group_half[3]; /* of 4^3 voxels */
    double pixel;        /* edges that a pixel is wide at distance 1, times the footprint */
    int has_color;
    cm_hit_colors hit;
    cm_cell_offsets offset[CM_DETAILS];
    cm_cell_offsets block; /* of the blocks of a region */
    cm_ray_ends ends;  /* voxels that are hit, whatever the pixels say that their centres fall on */
    atomic_int failed; /* 1: no memory */
} cm_update;

/* The desk of a map, which is made if there is none; NULL if there is no memory. */
cm_update_desk *cm_update_desk_of(cm_octree *octree);

/* What colors are mixed in, by the map's rule. */
void cm_update_make_parts(cm_update *update);

/* CM_ERROR_RANGE if all in front of what is so far away would be more voxels than there is memory for: depths beyond 2^20 edges,
 * which no map is wide, where nothing bounds what they free. */
cm_status cm_update_check_reach(const cm_octree *octree, float greatest);

/* A voxel's centre in the camera's axes. */
static inline void cm_update_place(const cm_update *update, const double place[3], double at[3])
{
    for (int axis = 0; axis < 3; axis++)
    {
        at[axis] = update->origin[axis] + place[0] * update->step[0][axis] +
                   place[1] * update->step[1][axis] + place[2] * update->step[2][axis];
    }
}

/* Half lengths of a box along the camera's axes around the centres of a cube of 2^level voxels, a little more for rounding at a
 * distance. */
void cm_update_half(const cm_update *update, int level, double distance, float half[3]);

/* A node in which something may happen: its region comes to the list. */
cm_status cm_update_list_region(cm_update *update, uint32_t node, const uint32_t place[3]);

/* A node of which all is missed comes to the other list, since nothing is to change before all regions are there. */
cm_status cm_update_list_miss(cm_update *update, uint32_t node);

/* All regions are there: what is missed is. Else the map is as it was before the view. */
void cm_update_end_lists(cm_update *update, cm_status status);

/* The memory of listed regions. */
uint64_t cm_update_listed_bytes(const cm_update *update);

/* After the work on them: those that are even again are given back. What the update comes to, with the status so far. */
cm_status cm_update_close_regions(cm_update *update, cm_status status);

/* May something happen to a region at a place whose voxels all have an alpha? Asked before memory is taken for it. */
int cm_update_may_change(const cm_update *update, const uint32_t place[3], uint8_t alpha);

/* The detail that a block of a region is updated in, where a footprint is so many edges: cells are no larger than they are there,
 * unless they are all alike. */
unsigned cm_update_detail(const cm_update *update, cm_region *region, unsigned block, double edges);

/* Update a region of a straight camera's view. */
void cm_update_region(cm_update *update, cm_region *region);

/* What a block's cells get: bits of hits and misses of eight groups of 64 cells, fewer of coarser details, and the pixels of hits.
 * all_missed: 1 if each cell of the block is missed. */
typedef struct cm_block_change
{
    unsigned detail;
    uint64_t hits[8];
    uint64_t misses[8];
    int32_t pixel[8][64];
} cm_block_change;

/* Into the block; pixels are indices into rules, of rows `stride` wide. 0 if there is no memory. */
int cm_update_block(cm_update *update, cm_region *region, unsigned block,
                    const cm_block_change *change);

/* All of a block is missed. */
void cm_update_free_block(cm_update *update, cm_region *region, unsigned block);

/* Does nothing happen in a cube of that class? */
static inline int cm_update_is_left_out(const cm_update *update, unsigned class_of)
{
    return class_of == CM_CUBE_OUTSIDE ||
           (class_of == CM_CUBE_FREE && update->octree->options.endpoints_only);
}

/* How many details a map may have: cells of more are not of a small map alone. */
static inline unsigned cm_update_details(const cm_octree *octree)
{
    return octree->options.levels < CM_DETAILS ? (unsigned)octree->options.levels : CM_DETAILS;
}

/* Is a small map, which does not fill its region, wholly around a block? */
int cm_update_is_within(const cm_octree *octree, const cm_region *region, unsigned block);

/* Which cells of a group are voxels of the map, and not beyond a small one. */
uint64_t cm_update_valid(const cm_octree *octree, const cm_region *region, unsigned block,
                         unsigned detail, unsigned group);

#endif
