/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "node_tree.h"

#include <stdlib.h>
#include <string.h>

#include "page.h"

/* ---- memory ---- */

int cm_nodes_make(cm_octree *octree)
{
    octree->node_room = 64;
    octree->node = calloc(octree->node_room, sizeof *octree->node);
    if (octree->node == NULL)
    {
        return 0;
    }
    octree->node[0].value = CM_UNKNOWN;
    octree->node_count = 8; /* eights begin at multiples of eight, so that 0 is the link of none */
    return 1;
}

void cm_nodes_drop(cm_octree *octree)
{
    for (size_t i = 0; i < octree->region_count; i++)
    {
        cm_region_drop(octree->region[i]);
    }
    free(octree->region);
    free(octree->free_region);
    free(octree->node);
}

/* The first of eight nodes that are not in use; 0 if there is no memory. */
static uint32_t take_eight(cm_octree *octree)
{
    if (octree->free_eight != 0)
    {
        const uint32_t first = octree->free_eight;
        octree->free_eight = octree->node[first].link;
        return first;
    }
    if (octree->node_count + 8 > octree->node_room)
    {
        const size_t room = 2 * octree->node_room;
        cm_node *more =
            room > UINT32_MAX ? NULL : cm_array_resized(octree->node, room, sizeof *more);
        if (more == NULL)
        {
            return 0;
        }
        octree->node = more;
        octree->node_room = room;
    }
    octree->node_count += 8;
    return (uint32_t)octree->node_count - 8;
}

static void give_eight(cm_octree *octree, uint32_t first)
{
    octree->node[first].link = octree->free_eight;
    octree->free_eight = first;
}

/* An index for a region; UINT32_MAX if there is no memory. */
static uint32_t take_region_index(cm_octree *octree)
{
    if (octree->free_region_count > 0)
    {
        return octree->free_region[--octree->free_region_count];
    }
    if (octree->region_count == octree->region_room)
    {
        const size_t room = octree->region_room == 0 ? 64 : 2 * octree->region_room;
        cm_region **more = cm_array_resized(octree->region, room, sizeof *more);
        if (more == NULL)
        {
            return UINT32_MAX;
        }
        octree->region = more;
        uint32_t *free_more = cm_array_resized(octree->free_region, room, sizeof *free_more);
        if (free_more == NULL)
        {
            return UINT32_MAX;
        }
        octree->free_region = free_more;
        octree->region_room = room;
    }
    octree->region[octree->region_count] = NULL;
    return (uint32_t)octree->region_count++;
}

void cm_node_forget_region(cm_octree *octree, uint32_t node)
{
    const uint32_t index = octree->node[node].link;
    octree->bytes -= cm_region_size(octree->region[index]);
    cm_region_drop(octree->region[index]);
    octree->region[index] = NULL;
    octree->free_region[octree->free_region_count++] = index;
    octree->node[node].kind = CM_NODE_PAGED;
}

/* ---- going down ---- */

cm_spot cm_node_find(const cm_octree *octree, const uint32_t place[3])
{
    cm_spot spot = {0, octree->tree_level, 0};
    while (octree->node[spot.node].kind == CM_NODE_INNER)
    {
        const cm_node *node = &octree->node[spot.node];
        spot.misses = cm_more_misses(spot.misses, node->value);
        spot.level--;
        spot.node = node->link + (place[0] >> spot.level & 1u) +
                    2u * (place[1] >> spot.level & 1u) + 4u * (place[2] >> spot.level & 1u);
    }
    if (octree->node[spot.node].kind != CM_NODE_LEAF)
    {
        spot.misses = cm_more_misses(spot.misses, octree->node[spot.node].value);
    }
    return spot;
}

void cm_node_miss(cm_octree *octree, uint32_t index, unsigned misses)
{
    cm_node *node = &octree->node[index];
    if (misses == 0)
    {
        return;
    }
    const uint8_t value = node->kind == CM_NODE_LEAF
                              ? cm_after_misses(&octree->rule, node->value, misses)
                              : cm_more_misses(node->value, misses);
    if (value != node->value)
    {
        node->value = value;
        node->changed = octree->step;
    }
}

/* The step of the last change: misses of what is at its lowest are none. */
static uint32_t later_if(int has_changed, uint32_t changed, uint32_t step)
{
    return has_changed && step > changed ? step : changed;
}

void cm_node_push(cm_octree *octree, uint32_t index)
{
    cm_node *node = &octree->node[index];
    if (node->kind == CM_NODE_INNER)
    {
        for (uint32_t child = 0; child < 8; child++)
        {
            cm_node *below = &octree->node[node->link + child];
            const uint8_t value = below->kind == CM_NODE_LEAF
                                      ? cm_after_misses(&octree->rule, below->value, node->value)
                                      : cm_more_misses(below->value, node->value);
            /* when it waited, not now */
            below->changed = later_if(value != below->value, below->changed, node->changed);
            below->value = value;
        }
        node->value = 0;
    }
    else if (node->kind == CM_NODE_REGION && node->value > 0)
    {
        cm_region *region = octree->region[node->link];
        uint8_t before[CM_REGION_BLOCKS];
        octree->bytes -= cm_region_size(region);
        for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
        {
            cm_block_drop_cells(region, block, &octree->rule);
        }
        octree->bytes += cm_region_size(region);
        memcpy(before, region->value, sizeof before);
        cm_region_miss(region, &octree->rule, node->value);
        for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
        {
            region->changed[block] = later_if(region->value[block] != before[block],
                                              region->changed[block], node->changed);
        }
        region->is_dirty = 1;
        node->value = 0;
    }
}

int cm_node_divide(cm_octree *octree, uint32_t index)
{
    if (octree->node[index].kind == CM_NODE_LEAF)
    {
        const uint32_t first = take_eight(octree);
        if (first == 0)
        {
            return 0;
        }
        cm_node *node = &octree->node[index];
        for (uint32_t child = 0; child < 8; child++)
        {
            octree->node[first + child] = *node;
        }
        node->kind = CM_NODE_INNER;
        node->link = first;
        node->value = 0;
    }
    cm_node_push(octree, index);
    return 1;
}

cm_status cm_node_reach(cm_octree *octree, const uint32_t place[3], int level, uint32_t *node)
{
    uint32_t at = 0;
    for (int l = octree->tree_level; l > level; l--)
    {
        if (!cm_node_divide(octree, at))
        {
            return CM_ERROR_MEMORY;
        }
        at = octree->node[at].link + (place[0] >> (l - 1) & 1u) + 2u * (place[1] >> (l - 1) & 1u) +
             4u * (place[2] >> (l - 1) & 1u);
    }
    *node = at;
    return CM_OK;
}

/* ---- regions ---- */

cm_status cm_node_take_region(cm_octree *octree, uint32_t index, cm_region *region)
{
    const uint32_t link = take_region_index(octree);
    if (link == UINT32_MAX)
    {
        cm_region_drop(region);
        return CM_ERROR_MEMORY;
    }
    octree->region[link] = region;
    octree->bytes += cm_region_size(region);
    region->node = index;
    region->used = octree->clock;
    cm_node *node = &octree->node[index];
    node->value = node->kind == CM_NODE_LEAF ? 0 : node->value;
    node->kind = CM_NODE_REGION;
    node->link = link;
    return CM_OK;
}

void cm_node_close(cm_octree *octree, uint32_t index, uint8_t alpha)
{
    cm_node *node = &octree->node[index];
    if (node->kind == CM_NODE_INNER)
    {
        const uint32_t first = node->link;
        for (uint32_t child = 0; child < 8; child++)
        {
            cm_node_close(octree, first + child, alpha);
        }
        give_eight(octree, first);
    }
    else if (node->kind == CM_NODE_REGION)
    {
        cm_node_forget_region(octree, index);
    }
    node->kind = CM_NODE_LEAF;
    node->value = alpha;
    node->link = 0;
}

cm_status cm_node_close_even(cm_octree *octree, uint32_t index)
{
    const cm_region *region = octree->region[octree->node[index].link];
    uint32_t changed = 0;
    uint8_t alpha;
    if (!cm_region_is_even(region, &alpha))
    {
        return CM_OK;
    }
    const cm_status status = region->has_page && octree->options.pages != NULL
                                 ? cm_page_remove(octree->options.pages, region->place)
                                 : CM_OK;
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        changed = region->changed[block] > changed ? region->changed[block] : changed;
    }
    cm_node_close(octree, index, alpha);
    octree->node[index].changed = changed;
    return status;
}

static void join(cm_octree *octree, uint32_t index)
{
    if (octree->node[index].kind != CM_NODE_INNER)
    {
        return;
    }
    cm_node_push(octree, index);
    const uint32_t first = octree->node[index].link;
    int are_equal = 1;
    for (uint32_t child = 0; child < 8; child++)
    {
        join(octree, first + child);
        const cm_node *at = &octree->node[first + child];
        are_equal &= at->kind == CM_NODE_LEAF && at->value == octree->node[first].value;
    }
    if (are_equal)
    {
        uint32_t changed = 0;
        for (uint32_t child = 0; child < 8; child++)
        {
            changed = octree->node[first + child].changed > changed
                          ? octree->node[first + child].changed
                          : changed;
        }
        const uint8_t value = octree->node[first].value;
        cm_node_close(octree, index, value);
        octree->node[index].changed = changed;
    }
}

void cm_nodes_join(cm_octree *octree)
{
    join(octree, 0);
}
