/* SPDX-License-Identifier: MIT */
#include "walk.h"

#include <math.h>
#include <string.h>

#include "interleave.h"
#include "node_tree.h"
#include "page.h"

double cm_place_world(const cm_octree *octree, int axis, double place)
{
    const double middle = (double)((uint64_t)1 << (octree->tree_level - 1));
    return octree->options.centre[axis] + (place - middle) * octree->options.edge;
}

double cm_world_place(const cm_octree *octree, int axis, double world)
{
    const double middle = (double)((uint64_t)1 << (octree->tree_level - 1));
    return floor((world - octree->options.centre[axis]) / octree->options.edge) + middle;
}

cm_voxel cm_voxel_at(const cm_octree *octree, const uint32_t place[3], int level, uint8_t alpha,
                     uint32_t color)
{
    const double size = (double)((uint64_t)1 << level), half = 0.5 * size;
    cm_voxel voxel = {
        .x = cm_place_world(octree, 0, place[0] + half),
        .y = cm_place_world(octree, 1, place[1] + half),
        .z = cm_place_world(octree, 2, place[2] + half),
        .edge = size * octree->options.edge,
        .level = level,
        .state = alpha > CM_UNKNOWN   ? CM_VOXEL_OCCUPIED
                 : alpha < CM_UNKNOWN ? CM_VOXEL_FREE
                                      : CM_VOXEL_UNKNOWN,
        .alpha = alpha,
        .has_color = alpha > CM_UNKNOWN && color != 0,
    };
    if (voxel.has_color)
    {
        cm_color_to(color, voxel.color);
    }
    return voxel;
}

void cm_walk_all(const cm_octree *octree, cm_walk *walk)
{
    memcpy(walk->first, octree->first, sizeof walk->first);
    memcpy(walk->beyond, octree->beyond, sizeof walk->beyond);
}

int cm_box_meets(const uint32_t first[3], const uint32_t beyond[3], const uint32_t place[3],
                 int level)
{
    int meets = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        meets &= place[axis] < beyond[axis] && (uint64_t)place[axis] + (1u << level) > first[axis];
    }
    return meets;
}

int cm_box_has(const uint32_t first[3], const uint32_t beyond[3], const uint32_t place[3],
               int level)
{
    int within = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        within &=
            place[axis] >= first[axis] && (uint64_t)place[axis] + (1u << level) <= beyond[axis];
    }
    return within;
}

static int is_old(const cm_walk *walk, uint32_t changed)
{
    return walk->since > 0 && changed <= walk->since;
}

/* Were a block's voxels all at the lowest before the misses that wait above? These change nothing then. */
static int is_at_lowest(const cm_octree *octree, const cm_region *region, unsigned block,
                        unsigned misses)
{
    uint8_t alpha;
    return cm_block_is_even(region, block, &octree->rule, 0, &alpha) &&
           cm_after_misses(&octree->rule, alpha, misses) == alpha;
}

static int walk_region(const cm_octree *octree, const cm_walk *walk, const cm_region *region,
                       unsigned misses, uint32_t missed)
{
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        if (walk->only_solid && !cm_block_is_solid(region, block))
        {
            continue;
        }
        unsigned in[3];
        cm_divide_3(block, in);
        const uint32_t place[3] = {region->place[0] + 8 * in[0], region->place[1] + 8 * in[1],
                                   region->place[2] + 8 * in[2]};
        if (!cm_box_meets(walk->first, walk->beyond, place, CM_BLOCK_LEVEL) ||
            (is_old(walk, region->changed[block]) &&
             (is_old(walk, missed) || is_at_lowest(octree, region, block, misses))))
        {
            continue;
        }
        /* to who looks for what is occupied the cells of one that is all free are nothing either way */
        const int has_cells = walk->only_solid && region->form[block] != CM_BLOCK_EVEN;
        uint8_t alpha;
        const int stops =
            !has_cells && cm_block_is_even(region, block, &octree->rule, misses, &alpha)
                ? walk->even(walk->user, place, CM_BLOCK_LEVEL, alpha)
                : walk->block(walk->user, region, block, misses);
        if (stops)
        {
            return 1;
        }
    }
    return 0;
}

/* Who is called may ask the same map, which with pages puts regions away: not this one. */
static int walk_held(const cm_octree *octree, const cm_walk *walk, cm_region *region,
                     unsigned misses, uint32_t missed)
{
    if (octree->options.pages == NULL)
    {
        return walk_region(octree, walk, region, misses, missed);
    }
    const uint8_t was_held = region->is_held;
    region->is_held = 1;
    const int stops = walk_region(octree, walk, region, misses, missed);
    region->is_held = was_held;
    return stops;
}

/* missed: the step of the last of the misses that wait above. */
static cm_status walk_node(const cm_octree *octree, const cm_walk *walk, uint32_t index,
                           const uint32_t place[3], int level, unsigned misses, uint32_t missed)
{
    const cm_node *node = &octree->node[index];
    if (!cm_box_meets(walk->first, walk->beyond, place, level))
    {
        return CM_OK;
    }
    if (node->kind == CM_NODE_LEAF)
    {
        const uint8_t alpha = cm_after_misses(&octree->rule, node->value, misses);
        const int is_same =
            is_old(walk, node->changed) && (is_old(walk, missed) || alpha == node->value);
        return !is_same && walk->even(walk->user, place, level, alpha) ? CM_ERROR_STOPPED : CM_OK;
    }
    const uint32_t last = node->value > 0 && node->changed > missed ? node->changed : missed;
    const unsigned more = cm_more_misses(misses, node->value);
    cm_status status = CM_OK;
    if (node->kind == CM_NODE_INNER)
    {
        const uint32_t link = node->link;
        for (uint32_t child = 0; status == CM_OK && child < 8; child++)
        {
            uint32_t below[3];
            for (int axis = 0; axis < 3; axis++)
            {
                below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
            }
            status = walk_node(octree, walk, link + child, below, level - 1, more, last);
        }
        return status;
    }
    if (node->kind == CM_NODE_REGION)
    {
        return walk_held(octree, walk, octree->region[node->link], more, last) ? CM_ERROR_STOPPED
                                                                               : CM_OK;
    }
    /* it is only looked at: memory has room for one more */
    cm_region *region = NULL;
    status = cm_page_get(octree, octree->options.pages, place, &region);
    if (status == CM_OK)
    {
        status = walk_region(octree, walk, region, more, last) ? CM_ERROR_STOPPED : CM_OK;
        cm_region_drop(region);
    }
    return status;
}

cm_status cm_walk_run(const cm_octree *octree, const cm_walk *walk)
{
    const uint32_t first[3] = {0, 0, 0};
    return walk_node(octree, walk, 0, first, octree->tree_level, 0, 0);
}
