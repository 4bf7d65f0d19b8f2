/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "paging.h"

#include <stdlib.h>

#include "interleave.h"
#include "page.h"

cm_status cm_node_region(cm_octree *octree, uint32_t index, const uint32_t place[3],
                         cm_region **region)
{
    cm_status status = CM_OK;
    const uint8_t kind = octree->node[index].kind;
    if (kind != CM_NODE_REGION)
    {
        cm_region *made = NULL;
        if (kind == CM_NODE_PAGED)
        {
            status = cm_page_get(octree, octree->options.pages, place, &made);
        }
        else
        {
            made = cm_region_make(place, octree->node[index].value);
            status = made == NULL ? CM_ERROR_MEMORY : CM_OK;
            for (unsigned block = 0; made != NULL && block < CM_REGION_BLOCKS; block++)
            {
                made->changed[block] = octree->node[index].changed;
            }
        }
        if (status == CM_OK)
        {
            status = cm_node_take_region(octree, index, made);
        }
        if (status != CM_OK)
        {
            return status;
        }
    }
    cm_node_push(octree, index);
    *region = octree->region[octree->node[index].link];
    (*region)->used = octree->clock;
    return CM_OK;
}

cm_status cm_node_look(const cm_octree *octree, uint32_t index, const uint32_t place[3],
                       const cm_region **region)
{
    cm_status status = CM_OK;
    if (octree->node[index].kind == CM_NODE_PAGED)
    {
        /* what the caller sees of the map does not change */
        cm_octree *pager = (cm_octree *)(uintptr_t)octree;
        const uint32_t corner[3] = {place[0] >> CM_REGION_LEVEL << CM_REGION_LEVEL,
                                    place[1] >> CM_REGION_LEVEL << CM_REGION_LEVEL,
                                    place[2] >> CM_REGION_LEVEL << CM_REGION_LEVEL};
        cm_region *got = NULL;
        pager->clock++;
        status = cm_page_get(octree, octree->options.pages, corner, &got);
        status = status == CM_OK ? cm_node_take_region(pager, index, got) : status;
        status = status == CM_OK ? cm_pages_trim(pager) : status;
    }
    if (status == CM_OK)
    {
        *region = octree->region[octree->node[index].link];
    }
    return status;
}

/* ---- the least recently used ---- */

static int by_use(const void *a, const void *b)
{
    const cm_region *const *p = a, *const *q = b;
    return (*p)->used < (*q)->used ? -1 : (*p)->used > (*q)->used;
}

/* Of two that were used together the one that is first in the order of keys goes first, whatever the indices. */
static int in_order(const void *a, const void *b)
{
    const cm_region *const *p = a, *const *q = b;
    const int order = by_use(a, b);
    const uint64_t k = cm_interleave((*p)->place), l = cm_interleave((*q)->place);
    return order != 0 ? order : k < l ? -1 : k > l;
}

cm_status cm_pages_trim(cm_octree *octree)
{
    const uint64_t most = octree->options.memory;
    if (most == 0 || octree->bytes <= most)
    {
        return CM_OK;
    }
    cm_region **list = cm_array_of(octree->region_count + 1, sizeof *list);
    if (list == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    size_t count = 0;
    for (size_t i = 0; i < octree->region_count; i++)
    {
        if (octree->region[i] != NULL && !octree->region[i]->is_held)
        {
            list[count++] = octree->region[i];
        }
    }
    qsort(list, count, sizeof *list, in_order);
    cm_status status = CM_OK;
    /* one stays, for who has just asked for it */
    for (size_t i = 0; status == CM_OK && i + 1 < count && octree->bytes > most - most / 8; i++)
    {
        octree->bytes -= cm_region_size(list[i]);
        status = list[i]->is_dirty ? cm_page_put(octree, octree->options.pages, list[i]) : CM_OK;
        octree->bytes += cm_region_size(list[i]);
        if (status == CM_OK)
        {
            cm_node_forget_region(octree, list[i]->node);
        }
    }
    free(list);
    return status;
}
