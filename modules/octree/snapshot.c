/* SPDX-License-Identifier: MIT */
#include "snapshot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "block_access.h"
#include "interleave.h"
#include "snapshot_cells.h"

/* Places of blocks are not negative when this is added, and they have 18 bits: those of voxels 21. */
#define OFFSET ((int64_t)1 << 20)

/* Of occupied voxels of maps without colors. */
#define GREY 178

typedef struct gathering
{
    cm_snapshot *snapshot;
    size_t block_room;
    size_t color_room;
    const double *least;
    const double *greatest;
} gathering;

/* Room for so many elements more, at least doubled. 0 if there is no memory. */
static int make_room(void **list, size_t *room, size_t count, size_t more, size_t size)
{
    if (count + more <= *room)
    {
        return 1;
    }
    const size_t wanted = 2 * (count + more) + 256;
    void *longer = realloc(*list, wanted * size);
    if (longer == NULL)
    {
        return 0;
    }
    *list = longer;
    *room = wanted;
    return 1;
}

static int is_beside(const gathering *g, const int64_t corner[3])
{
    int beside = 0;
    for (int axis = 0; axis < 3; axis++)
    {
        beside |= (double)corner[axis] > g->greatest[axis] ||
                  (double)(corner[axis] + CM_BLOCK_EDGE) < g->least[axis];
    }
    return beside;
}

/* The highest bits of 64 bytes. */
static uint64_t occupied_of(const uint8_t alpha[64])
{
    uint64_t bits = 0;
    for (unsigned i = 0; i < 64; i += 8)
    {
        const uint8_t *a = alpha + i;
        const uint64_t eight = a[0] | (uint64_t)a[1] << 8 | (uint64_t)a[2] << 16 |
                               (uint64_t)a[3] << 24 | (uint64_t)a[4] << 32 | (uint64_t)a[5] << 40 |
                               (uint64_t)a[6] << 48 | (uint64_t)a[7] << 56;
        bits |= ((eight >> 7 & 0x0101010101010101u) * 0x0102040810204080u >> 56) << i;
    }
    return bits;
}

static void copy_colors(const gathering *g, const cm_seen_node *node, const cm_block_values *block)
{
    uint8_t(*to)[3] = g->snapshot->color + g->snapshot->color_count;
    for (unsigned w = 0; w < 8; w++)
    {
        const unsigned count = cm_bit_count(node->mask[w]);
        uint64_t left = node->mask[w];
        for (unsigned i = 0; i < count; i++, left &= left - 1)
        {
            const unsigned cell = 64 * w + cm_bit_count((left & (~left + 1)) - 1);
            if (block->color == NULL)
            {
                memset(*to++, GREY, 3);
            }
            else
            {
                memcpy(*to++, block->color[cell], 3);
            }
        }
    }
    g->snapshot->color_count = (size_t)(to - g->snapshot->color);
}

static int gather(void *user, const cm_block_values *block)
{
    gathering *g = user;
    cm_snapshot *snapshot = g->snapshot;
    if (is_beside(g, block->corner))
    {
        return 0;
    }
    void *nodes = snapshot->node[0];
    void *colors = snapshot->color;
    const int has_room =
        make_room(&nodes, &g->block_room, snapshot->node_count[0], 1, sizeof(cm_seen_node)) &&
        make_room(&colors, &g->color_room, snapshot->color_count, CM_BLOCK_CELLS, 3);
    snapshot->node[0] = nodes;
    snapshot->color = colors;
    if (!has_room)
    {
        return 1;
    }
    cm_seen_node node = {.child = (uint32_t)snapshot->color_count};
    for (unsigned axis = 0; axis < 3; axis++)
    {
        node.place[axis] = (int32_t)((block->corner[axis] + OFFSET) / CM_BLOCK_EDGE);
    }
    for (unsigned w = 0; w < 8; w++)
    {
        node.mask[w] = occupied_of(block->alpha + 64 * w);
    }
    node.cell = (uint32_t)snapshot->cell_count;
    snapshot->cell_count += cm_seen_node_count(&node);
    copy_colors(g, &node, block);
    snapshot->node[0][snapshot->node_count[0]++] = node;
    return 0;
}

typedef struct filling
{
    const cm_snapshot *snapshot;
    int stage;
} filling;

static void fill_blocks(size_t begin, size_t end, void *user)
{
    const filling *f = user;
    for (size_t i = begin; i < end; i++)
    {
        cm_seen_block_fill(f->snapshot, &f->snapshot->node[0][i]);
    }
}

/* Do the nodes of a stage fit below one? Then corner is that one's. */
static int fits_one(const cm_snapshot *snapshot, int stage, int32_t corner[3])
{
    int fits = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        int32_t least = INT32_MAX, most = INT32_MIN;
        for (size_t i = 0; i < snapshot->node_count[stage]; i++)
        {
            const int32_t place = snapshot->node[stage][i].place[axis];
            least = place < least ? place : least;
            most = place > most ? place : most;
        }
        corner[axis] = least;
        fits = fits && most - least < 8;
    }
    return fits;
}

/* Nodes above those of a stage: each where its children are the same eighths, or one for all, whose lower corner is that of the
 * first of its children. */
static void group(cm_snapshot *snapshot, int stage, const int32_t *corner)
{
    const cm_seen_node *below = snapshot->node[stage - 1];
    cm_seen_node *node = snapshot->node[stage];
    size_t count = 0;
    for (size_t i = 0; i < snapshot->node_count[stage - 1]; i++)
    {
        int32_t place[3], within[3];
        for (int axis = 0; axis < 3; axis++)
        {
            place[axis] = corner != NULL ? 0 : below[i].place[axis] >> 3;
            within[axis] =
                corner != NULL ? below[i].place[axis] - corner[axis] : below[i].place[axis] & 7;
        }
        if (count == 0 || memcmp(node[count - 1].place, place, sizeof place) != 0)
        {
            const uint32_t table = (uint32_t)(512 * snapshot->table_count++);
            node[count] = (cm_seen_node){.child = table};
            memcpy(node[count++].place, place, sizeof place);
        }
        const unsigned index =
            cm_interleave_3((unsigned)within[0], (unsigned)within[1], (unsigned)within[2]);
        node[count - 1].mask[index / 64] |= (uint64_t)1 << (index % 64);
        snapshot->children[node[count - 1].child + index] = (uint32_t)i;
    }
    for (size_t i = 0; i < count; i++)
    {
        node[i].cell = (uint32_t)snapshot->cell_count;
        snapshot->cell_count += cm_seen_node_count(&node[i]);
    }
    snapshot->node_count[stage] = count;
}

/* How many nodes are above those of a stage at most: as often as the eighths change. */
static size_t count_groups(const cm_snapshot *snapshot, int stage)
{
    const cm_seen_node *node = snapshot->node[stage];
    size_t count = 0;
    for (size_t i = 0; i < snapshot->node_count[stage]; i++)
    {
        int differs = i == 0;
        for (int axis = 0; axis < 3 && i > 0; axis++)
        {
            differs = differs || node[i].place[axis] >> 3 != node[i - 1].place[axis] >> 3;
        }
        count += (size_t)differs;
    }
    return count;
}

/* One stage more; 0 if there is no memory. */
static int build_stage(cm_snapshot *snapshot, int stage, const int32_t *corner)
{
    const size_t count = corner != NULL ? 1 : count_groups(snapshot, stage - 1);
    const size_t tables = snapshot->table_count + count;
    snapshot->node[stage] = calloc(count, sizeof *snapshot->node[stage]);
    uint32_t *children = realloc(snapshot->children, 512 * tables * sizeof *children);
    snapshot->children = children == NULL ? snapshot->children : children;
    if (snapshot->node[stage] == NULL || children == NULL)
    {
        return 0;
    }
    group(snapshot, stage, corner);
    return 1;
}

static cm_status fill_all(cm_snapshot *snapshot, cm_pool *pool)
{
    snapshot->cell = malloc((snapshot->cell_count + 1) * sizeof *snapshot->cell);
    if (snapshot->cell == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    filling f = {snapshot, 0};
    cm_pool_run(pool, snapshot->node_count[0], 256, fill_blocks, &f);
    for (int stage = 1; stage <= snapshot->top; stage++)
    {
        for (size_t i = 0; i < snapshot->node_count[stage]; i++)
        {
            cm_seen_node_fill(snapshot, stage, &snapshot->node[stage][i]);
        }
    }
    return CM_OK;
}

static cm_status build_above(cm_snapshot *snapshot, cm_pool *pool)
{
    int32_t corner[3];
    int stage = 0;
    while (!fits_one(snapshot, stage, corner))
    {
        stage++;
        if (!build_stage(snapshot, stage, NULL))
        {
            return CM_ERROR_MEMORY;
        }
    }
    stage++;
    if (!build_stage(snapshot, stage, corner))
    {
        return CM_ERROR_MEMORY;
    }
    snapshot->top = stage;
    for (int axis = 0; axis < 3; axis++)
    {
        snapshot->corner[axis] = ((int64_t)corner[axis] << 3 * stage) - OFFSET;
    }
    return fill_all(snapshot, pool);
}

cm_status cm_snapshot_make(const cm_octree *octree, const double least[3], const double greatest[3],
                           cm_pool *pool, cm_snapshot *snapshot)
{
    *snapshot = (cm_snapshot){.top = -1};
    for (int i = 0; i < 256; i++)
    {
        snapshot->thickness[i] = i == 255 ? INFINITY : (float)-log2(1.0 - i / 255.0);
    }
    gathering g = {.snapshot = snapshot, .least = least, .greatest = greatest};
    const cm_status status = cm_octree_occupied_blocks(octree, gather, &g);
    if (status == CM_ERROR_STOPPED)
    {
        return CM_ERROR_MEMORY;
    }
    if (status != CM_OK || snapshot->node_count[0] == 0)
    {
        return status;
    }
    return build_above(snapshot, pool);
}

void cm_snapshot_drop(cm_snapshot *snapshot)
{
    for (int stage = 0; stage < CM_SNAPSHOT_STAGES; stage++)
    {
        free(snapshot->node[stage]);
    }
    free(snapshot->children);
    free(snapshot->cell);
    free(snapshot->color);
    *snapshot = (cm_snapshot){.top = -1};
}
