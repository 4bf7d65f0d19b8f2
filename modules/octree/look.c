/* SPDX-License-Identifier: MIT
 *
 * A voxel of any level: what is there, or the average of what is below it.
 */
#include <math.h>
#include <string.h>

#include "cube_sum.h"
#include "interleave.h"
#include "node_tree.h"
#include "paging.h"
#include "walk.h"

static const cm_voxel nothing = {0};

/* Sums over a cube. */
typedef struct look
{
    const cm_octree *octree;
    uint32_t place[3];
    int level;
    cm_cube_sum sum;
} look;

static int add_even(void *user, const uint32_t place[3], int level, uint8_t alpha)
{
    look *work = user;
    (void)place;
    cm_cube_add(&work->sum, alpha, level < work->level ? level : work->level);
    return 0;
}

static int add_block(void *user, const cm_region *region, unsigned block, unsigned misses)
{
    look *work = user;
    uint8_t alpha[512];
    uint32_t color[512];
    const unsigned detail = cm_block_read(region, block, &work->octree->rule, misses, alpha, color);
    /* a cube of less than a block is some of its cells, one after the other; but a whole small map is of several blocks,
     * and what else they have is unknown */
    unsigned first = 0, count = 512;
    if (work->level < CM_BLOCK_LEVEL && work->level < work->octree->options.levels)
    {
        first = cm_interleave_3(work->place[0] & 7u, work->place[1] & 7u, work->place[2] & 7u);
        count = 1u << 3 * work->level;
    }
    cm_cube_add_cells(&work->sum, alpha, color, detail, first, count);
    return 0;
}

static cm_status average_at(const cm_octree *octree, const uint32_t place[3], int level,
                            cm_voxel *found)
{
    look work = {.level = level, .octree = octree};
    cm_walk walk = {.user = &work, .even = add_even, .block = add_block};
    for (int axis = 0; axis < 3; axis++)
    {
        /* cubes are counted from the root, which is in the middle of the tree of a small map */
        work.place[axis] =
            octree->first[axis] + ((place[axis] - octree->first[axis]) >> level << level);
        walk.first[axis] = work.place[axis];
        walk.beyond[axis] = work.place[axis] + (1u << level);
    }
    const cm_status status = cm_walk_run(octree, &walk);
    if (status != CM_OK)
    {
        return status;
    }
    *found = cm_cube_voxel(octree, &work.sum, work.place, level);
    return CM_OK;
}

/* The voxel that was updated as one. */
static cm_status finest_at(const cm_octree *octree, const uint32_t place[3], cm_voxel *found)
{
    const cm_spot spot = cm_node_find(octree, place);
    const cm_node *node = &octree->node[spot.node];
    if (node->kind == CM_NODE_LEAF)
    {
        *found = cm_voxel_at(octree, place, 0,
                             cm_after_misses(&octree->rule, node->value, spot.misses), 0);
        return CM_OK;
    }
    const cm_region *region = NULL;
    const cm_status status = cm_node_look(octree, spot.node, place, &region);
    if (status != CM_OK)
    {
        return status;
    }
    const unsigned block = cm_interleave_3(place[0] >> 3, place[1] >> 3, place[2] >> 3);
    const unsigned cell = cm_interleave_3(place[0], place[1], place[2]);
    uint32_t color = 0;
    const uint8_t alpha = cm_block_cell(region, block, &octree->rule, spot.misses, cell, &color);
    uint8_t only;
    const unsigned detail = cm_block_is_even(region, block, &octree->rule, spot.misses, &only)
                                ? 0
                                : region->detail[block];
    const uint32_t corner[3] = {place[0] >> detail << detail, place[1] >> detail << detail,
                                place[2] >> detail << detail};
    *found = cm_voxel_at(octree, corner, (int)detail, alpha, color);
    return CM_OK;
}

cm_status cm_look_at(const cm_octree *octree, const double point[3], int level, cm_voxel *found)
{
    uint32_t place[3];
    int is_inside = level >= 0 && level <= octree->options.levels;
    *found = nothing;
    for (int axis = 0; is_inside && axis < 3; axis++)
    {
        const double at = cm_world_place(octree, axis, point[axis]);
        is_inside = at >= octree->first[axis] && at < octree->beyond[axis];
        place[axis] = is_inside ? (uint32_t)at : 0;
    }
    return !is_inside   ? CM_OK
           : level == 0 ? finest_at(octree, place, found)
                        : average_at(octree, place, level, found);
}

int cm_octree_at(const cm_octree *octree, const double point[3], int level, cm_voxel *voxel)
{
    cm_voxel found = nothing;
    if (octree != NULL && point != NULL && cm_look_at(octree, point, level, &found) != CM_OK)
    {
        found = nothing;
    }
    if (voxel != NULL)
    {
        *voxel = found;
    }
    return found.state;
}
