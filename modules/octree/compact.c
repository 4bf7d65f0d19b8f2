/* SPDX-License-Identifier: MIT
 *
 * A map in less memory.
 */
#include "node_tree.h"
#include "ray_index.h"

cm_status cm_octree_compact(cm_octree *octree)
{
    if (octree == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_ray_index_forget(octree);
    cm_status status = CM_OK;
    for (size_t i = 0; status == CM_OK && i < octree->region_count; i++)
    {
        cm_region *region = octree->region[i];
        if (region == NULL)
        {
            continue;
        }
        const uint32_t node = region->node;
        cm_node_push(octree, node);
        octree->bytes -= cm_region_size(region);
        for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
        {
            status = cm_block_pack(region, block, &octree->rule) ? status : CM_ERROR_MEMORY;
        }
        octree->bytes += cm_region_size(region);
        const cm_status closed = cm_node_close_even(octree, node);
        status = status == CM_OK ? closed : status;
    }
    cm_nodes_join(octree);
    return status;
}
