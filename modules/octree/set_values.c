/* SPDX-License-Identifier: MIT
 *
 * Values that come from elsewhere into a map: cubes and blocks.
 */
#include <string.h>

#include "block_access.h"
#include "interleave.h"
#include "node_tree.h"
#include "paging.h"
#include "ray_index.h"
#include "update_desk.h"
#include "voxel_region.h"

/* From the root's centre to the tree's corner; 0 if the cube is not in the tree. */
static int place_of(const cm_octree *octree, const int64_t corner[3], int level, uint32_t place[3])
{
    const int64_t middle = (int64_t)1 << (octree->tree_level - 1);
    const int64_t length = (int64_t)1 << level;
    int is_inside = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        const int64_t at = corner[axis] + middle;
        is_inside &= at >= 0 && at + length <= 2 * middle && at % length == 0;
        place[axis] = is_inside ? (uint32_t)at : 0;
    }
    return is_inside;
}

static unsigned block_at(const uint32_t place[3])
{
    return cm_interleave_3(place[0] >> 3, place[1] >> 3, place[2] >> 3);
}

static cm_status region_at(cm_octree *octree, const uint32_t place[3], cm_region **region)
{
    const uint32_t corner[3] = {place[0] >> CM_REGION_LEVEL << CM_REGION_LEVEL,
                                place[1] >> CM_REGION_LEVEL << CM_REGION_LEVEL,
                                place[2] >> CM_REGION_LEVEL << CM_REGION_LEVEL};
    uint32_t node = 0;
    cm_ray_index_forget(octree);
    octree->clock++;
    const cm_status status = cm_node_reach(octree, corner, CM_REGION_LEVEL, &node);
    return status == CM_OK ? cm_node_region(octree, node, corner, region) : status;
}

cm_status cm_octree_set_cube(cm_octree *octree, const int64_t corner[3], int level, uint8_t alpha)
{
    uint32_t place[3], node = 0;
    if (level < CM_BLOCK_LEVEL || level > octree->tree_level ||
        !place_of(octree, corner, level, place))
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_ray_index_forget(octree);
    cm_status status;
    if (level >= CM_REGION_LEVEL && octree->options.levels >= CM_REGION_LEVEL)
    {
        status = cm_node_reach(octree, place, level, &node);
        if (status == CM_OK)
        {
            cm_node_close(octree, node, alpha);
            octree->node[node].changed = octree->step;
        }
        return status;
    }
    uint8_t values[512];
    memset(values, alpha, sizeof values);
    const int64_t edge = CM_BLOCK_EDGE, count = ((int64_t)1 << level) / edge;
    status = CM_OK;
    for (int64_t i = 0; status == CM_OK && i < count * count * count; i++)
    {
        const int64_t at[3] = {corner[0] + i % count * edge, corner[1] + i / count % count * edge,
                               corner[2] + i / count / count * edge};
        status = cm_octree_set_block(octree, at, values, NULL);
    }
    return status;
}

/* Values of a small map's own voxels; the others stay unknown. */
static void keep_own(const cm_octree *octree, const cm_region *region, unsigned block,
                     uint8_t alpha[512])
{
    for (unsigned group = 0; group < 8; group++)
    {
        const uint64_t valid = cm_update_valid(octree, region, block, 0, group);
        for (unsigned i = 0; i < 64; i++)
        {
            alpha[64 * group + i] = valid >> i & 1u ? alpha[64 * group + i] : CM_UNKNOWN;
        }
    }
}

static int put_values(cm_octree *octree, cm_region *region, unsigned block,
                      const uint8_t values[512], const uint8_t (*color)[3])
{
    cm_block_even(region, block, CM_UNKNOWN);
    uint8_t *alpha = cm_block_open(region, block, &octree->rule, 0);
    if (alpha == NULL)
    {
        return 0;
    }
    memcpy(alpha, values, 512);
    keep_own(octree, region, block, alpha);
    int is_solid = 0;
    for (unsigned cell = 0; cell < 512; cell++)
    {
        is_solid |= alpha[cell] > CM_UNKNOWN;
    }
    cm_region_mark(region, block, is_solid);
    uint32_t *word = color == NULL ? NULL : cm_block_colors(region, block);
    if (color != NULL && word == NULL)
    {
        return 0;
    }
    for (unsigned cell = 0; color != NULL && cell < 512; cell++)
    {
        word[cell] = alpha[cell] > CM_UNKNOWN ? cm_color_word(color[cell]) : 0;
    }
    if (color == NULL && alpha[0] > CM_UNKNOWN && memcmp(alpha, alpha + 1, 511) == 0)
    {
        cm_block_even(region, block, alpha[0]);
    }
    else
    {
        cm_block_settle(region, block);
    }
    /* Colors are packed at once: a large voxel of a file, some bytes there, is many blocks, each some kilobytes if it stays open. */
    return color == NULL || cm_block_pack(region, block, &octree->rule);
}

cm_status cm_octree_set_block(cm_octree *octree, const int64_t corner[3], const uint8_t alpha[512],
                              const uint8_t (*color)[3])
{
    uint32_t place[3];
    cm_region *region = NULL;
    if (!place_of(octree, corner, CM_BLOCK_LEVEL, place))
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = region_at(octree, place, &region);
    if (status != CM_OK)
    {
        return status;
    }
    octree->bytes -= cm_region_size(region);
    const int good = put_values(octree, region, block_at(place), alpha, color);
    octree->bytes += cm_region_size(region);
    region->changed[block_at(place)] = octree->step;
    region->is_dirty = 1;
    return good ? cm_pages_trim(octree) : CM_ERROR_MEMORY;
}
