/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "snapshot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "block_mask.h"
#include "interleave.h"
#include "snapshot_cells.h"
#include "walk.h"

typedef struct gathering
{
    cm_snapshot *snapshot;
    size_t block_room;
    size_t color_room;
    size_t even_room[CM_SNAPSHOT_STAGES];
    const cm_count_rule *rule;
    const cm_snapshot_bounds *bounds;
    double middle; /* of the tree */
} gathering;

/* Room for so many elements more, at least doubled. 0 if there is no memory. */
static int make_room(void **list, size_t *room, size_t count, size_t more, size_t size)
{
    if (count + more <= *room)
    {
        return 1;
    }
    const size_t wanted = 2 * (count + more) + 256;
    void *longer = cm_array_resized(*list, wanted, size);
    if (longer == NULL)
    {
        return 0;
    }
    *list = longer;
    *room = wanted;
    return 1;
}

/* Is a cube beside of what is wanted? */
static int is_beside(const gathering *g, const uint32_t place[3], double size)
{
    const cm_snapshot_bounds *b = g->bounds;
    const double reach = 0.8661 * size + b->margin; /* of its corners from its middle */
    double at[3];
    int beside = 0;
    for (int axis = 0; axis < 3; axis++)
    {
        const double low = place[axis] - g->middle;
        at[axis] = low + 0.5 * size;
        beside |= low > b->greatest[axis] || low + size < b->least[axis];
    }
    for (int i = 0; i < b->planes; i++)
    {
        const double *n = b->plane[i];
        beside |= n[0] * at[0] + n[1] * at[1] + n[2] * at[2] < n[3] - reach;
    }
    return beside;
}

/* Is nothing of a cube beside? */
static int is_within(const gathering *g, const uint32_t place[3], double size)
{
    const cm_snapshot_bounds *b = g->bounds;
    double at[3];
    int within = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        const double low = place[axis] - g->middle;
        at[axis] = low + 0.5 * size;
        within = within && low >= b->least[axis] && low + size <= b->greatest[axis];
    }
    for (int i = 0; within && i < b->planes; i++)
    {
        const double *n = b->plane[i];
        within = n[0] * at[0] + n[1] * at[1] + n[2] * at[2] >= n[3] - b->margin + 0.8661 * size;
    }
    return within;
}

/* Colors of what is occupied, from those of all cells; NULL: none. */
static void copy_colors(cm_snapshot *snapshot, const cm_seen_node *node, const uint32_t *color)
{
    uint32_t *to = snapshot->color + snapshot->color_count;
    for (unsigned w = 0; w < 8; w++)
    {
        for (uint64_t left = node->mask[w]; left != 0; left &= left - 1)
        {
            *to++ = color == NULL ? 0 : color[64 * w + cm_lowest_bit(left)];
        }
    }
    snapshot->color_count = (size_t)(to - snapshot->color);
}

/* A block with what is occupied. Returns what is not 0 if there is no memory. */
static int add_block(gathering *g, const uint32_t place[3], cm_seen_node *node,
                     const uint32_t *color)
{
    cm_snapshot *snapshot = g->snapshot;
    void *nodes = snapshot->node[0];
    void *colors = snapshot->color;
    const int has_room =
        make_room(&nodes, &g->block_room, snapshot->node_count[0], 1, sizeof(cm_seen_node)) &&
        make_room(&colors, &g->color_room, snapshot->color_count, 512, sizeof *snapshot->color);
    snapshot->node[0] = nodes;
    snapshot->color = colors;
    if (!has_room)
    {
        return 1;
    }
    node->child = (uint32_t)snapshot->color_count;
    node->cell = (uint32_t)snapshot->cell_count;
    for (int axis = 0; axis < 3; axis++)
    {
        node->place[axis] = (int32_t)(place[axis] >> 3);
    }
    snapshot->cell_count += cm_seen_node_count(node);
    copy_colors(snapshot, node, color);
    snapshot->node[0][snapshot->node_count[0]++] = *node;
    return 0;
}

/* The full block; 0 if there is no memory. */
static int make_full_block(gathering *g)
{
    cm_snapshot *snapshot = g->snapshot;
    void *colors = snapshot->color;
    const int has_room =
        make_room(&colors, &g->color_room, snapshot->color_count, 512, sizeof *snapshot->color);
    snapshot->color = colors;
    if (has_room)
    {
        cm_seen_node *full = &snapshot->full[0];
        memset(full->mask, 0xff, sizeof full->mask);
        full->is_copy = 1;
        full->child = (uint32_t)snapshot->color_count;
        full->cell = (uint32_t)snapshot->cell_count;
        snapshot->cell_count += cm_seen_node_count(full);
        copy_colors(snapshot, full, NULL);
        snapshot->full_top = 0;
    }
    return has_room;
}

/* A full node of a stage. Returns what is not 0 if there is no memory. */
static int add_full(gathering *g, const uint32_t place[3], int stage)
{
    cm_snapshot *snapshot = g->snapshot;
    if (snapshot->full_top < 0 && !make_full_block(g))
    {
        return 1;
    }
    snapshot->full_top = stage > snapshot->full_top ? stage : snapshot->full_top;
    void *nodes = snapshot->node[stage];
    size_t *room = stage == 0 ? &g->block_room : &g->even_room[stage];
    const int has_room =
        make_room(&nodes, room, snapshot->node_count[stage], 1, sizeof(cm_seen_node));
    snapshot->node[stage] = nodes;
    if (has_room)
    {
        cm_seen_node *node = &snapshot->node[stage][snapshot->node_count[stage]++];
        *node = snapshot->full[0];
        for (int axis = 0; axis < 3; axis++)
        {
            node->place[axis] = (int32_t)(place[axis] >> (3 * stage + 3));
        }
    }
    return !has_room;
}

/* An even cube, in the order of keys: as few nodes as are wholly wanted, and blocks where some are beside. */
static int gather_even(void *user, const uint32_t place[3], int level, uint8_t alpha)
{
    gathering *g = user;
    const double size = cm_size_of_level(level);
    if (alpha <= CM_UNKNOWN || is_beside(g, place, size))
    {
        return 0;
    }
    if (level <= CM_BLOCK_LEVEL || (level % 3 == 0 && is_within(g, place, size)))
    {
        return add_full(g, place, level <= CM_BLOCK_LEVEL ? 0 : level / 3 - 1);
    }
    int stops = 0;
    for (unsigned child = 0; !stops && child < 8; child++)
    {
        uint32_t below[3];
        for (int axis = 0; axis < 3; axis++)
        {
            below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
        }
        stops = gather_even(user, below, level - 1, alpha);
    }
    return stops;
}

/* The colors of a block that is not stored as one a voxel. */
static const uint32_t *unpack(const gathering *g, const cm_region *region, unsigned block,
                              unsigned misses, uint32_t color[512])
{
    uint8_t alpha[512];
    uint32_t cell_color[512];
    const unsigned detail = cm_block_read(region, block, g->rule, misses, alpha, cell_color);
    for (unsigned cell = 0; cell < 512; cell++)
    {
        color[cell] = cell_color[cell >> 3 * detail];
    }
    return color;
}

/* What is read some blocks later comes to the cache meanwhile: most of the time is waiting for memory. */
static void prefetch(const cm_region *region, unsigned block)
{
#if defined(__GNUC__)
    const unsigned later = block + 4 < CM_REGION_BLOCKS ? block + 4 : block;
    const uint8_t *alpha = region->alpha[later];
    for (unsigned i = 0; alpha != NULL && region->form[later] == CM_BLOCK_PLAIN && i < 512; i += 64)
    {
        __builtin_prefetch(alpha + i);
    }
#else
    (void)region;
    (void)block;
#endif
}

static int gather_block(void *user, const cm_region *region, unsigned block, unsigned misses)
{
    gathering *g = user;
    unsigned in[3];
    cm_divide_3(block, in);
    const uint32_t place[3] = {region->place[0] + 8 * in[0], region->place[1] + 8 * in[1],
                               region->place[2] + 8 * in[2]};
    if (is_beside(g, place, 8.0))
    {
        return 0;
    }
    prefetch(region, block);
    cm_seen_node node = {.pairs = 0};
    if (!cm_block_mask(region, block, g->rule, misses, node.mask))
    {
        return 0;
    }
    uint32_t unpacked[512];
    const int is_plain = region->form[block] == CM_BLOCK_PLAIN && region->detail[block] == 0;
    const uint32_t *color = !is_plain               ? unpack(g, region, block, misses, unpacked)
                            : region->color == NULL ? NULL
                                                    : region->color[block];
    return add_block(g, place, &node, color);
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
        const cm_seen_node *node = &f->snapshot->node[0][i];
        if (!node->is_copy)
        {
            cm_seen_block_fill(f->snapshot, node);
        }
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

static uint64_t key_of(const cm_seen_node *node)
{
    const uint32_t place[3] = {(uint32_t)node->place[0], (uint32_t)node->place[1],
                               (uint32_t)node->place[2]};
    return cm_interleave(place);
}

/* The full node of a stage, and the copies of it that were gathered between those that have nodes below, in the order of keys. */
static void merge_full(cm_snapshot *snapshot, int stage, const cm_seen_node *copies, size_t count)
{
    cm_seen_node *full = &snapshot->full[stage], *node = snapshot->node[stage];
    *full = (cm_seen_node){.child = (uint32_t)(512 * snapshot->table_count++), .is_copy = 1};
    memset(full->mask, 0xff, sizeof full->mask);
    for (unsigned i = 0; i < 512; i++)
    {
        snapshot->children[full->child + i] = (uint32_t)snapshot->node_count[stage - 1];
    }
    full->cell = (uint32_t)snapshot->cell_count;
    snapshot->cell_count += cm_seen_node_count(full);
    size_t own = snapshot->node_count[stage], at = own + count;
    snapshot->node_count[stage] = at;
    node[at] = *full;
    while (count > 0)
    {
        if (own > 0 && key_of(&node[own - 1]) > key_of(&copies[count - 1]))
        {
            node[--at] = node[--own];
            continue;
        }
        node[--at] = *full;
        memcpy(node[at].place, copies[--count].place, sizeof node[at].place);
    }
}

/* One stage more; 0 if there is no memory. */
static int build_stage(cm_snapshot *snapshot, int stage, const int32_t *corner)
{
    const size_t count = corner != NULL ? 1 : count_groups(snapshot, stage - 1);
    cm_seen_node *copies = snapshot->node[stage];
    const size_t copy_count = snapshot->node_count[stage];
    snapshot->node[stage] = calloc(count + copy_count + 1, sizeof *snapshot->node[stage]);
    snapshot->node_count[stage] = 0;
    const size_t tables = snapshot->table_count + count + 1;
    uint32_t *children = cm_array_resized(snapshot->children, tables, 512 * sizeof *children);
    snapshot->children = children == NULL ? snapshot->children : children;
    const int has_room = snapshot->node[stage] != NULL && children != NULL;
    if (has_room)
    {
        group(snapshot, stage, corner);
    }
    if (has_room && stage <= snapshot->full_top)
    {
        merge_full(snapshot, stage, copies, copy_count);
    }
    free(copies);
    return has_room;
}

/* The nodes of a stage above blocks; copies have the cells of the full one. */
static void fill_stage(cm_snapshot *snapshot, int stage)
{
    if (stage <= snapshot->full_top)
    {
        cm_seen_node_fill(snapshot, stage, &snapshot->full[stage]);
    }
    for (size_t i = 0; i < snapshot->node_count[stage]; i++)
    {
        if (!snapshot->node[stage][i].is_copy)
        {
            cm_seen_node_fill(snapshot, stage, &snapshot->node[stage][i]);
        }
    }
}

static cm_status fill_all(cm_snapshot *snapshot, cm_pool *pool)
{
    snapshot->cell = cm_array_of(snapshot->cell_count + 1, sizeof *snapshot->cell);
    if (snapshot->cell == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    filling f = {snapshot, 0};
    cm_pool_run(pool, snapshot->node_count[0], 256, fill_blocks, &f);
    if (snapshot->full_top >= 0)
    {
        cm_seen_block_fill(snapshot, &snapshot->full[0]);
    }
    for (int stage = 1; stage <= snapshot->top; stage++)
    {
        fill_stage(snapshot, stage);
    }
    return CM_OK;
}

static cm_status build_above(cm_snapshot *snapshot, cm_pool *pool)
{
    int32_t corner[3];
    int stage = 0;
    while (stage < snapshot->full_top || !fits_one(snapshot, stage, corner))
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
        snapshot->corner[axis] = ((int64_t)corner[axis] << 3 * stage) - snapshot->middle;
    }
    return fill_all(snapshot, pool);
}

/* The full block behind the others; 0 if there is no memory. */
static int end_with_full(gathering *g)
{
    cm_snapshot *snapshot = g->snapshot;
    void *nodes = snapshot->node[0];
    const int has_room =
        make_room(&nodes, &g->block_room, snapshot->node_count[0], 1, sizeof(cm_seen_node));
    snapshot->node[0] = nodes;
    if (has_room)
    {
        snapshot->node[0][snapshot->node_count[0]] = snapshot->full[0];
    }
    return has_room;
}

/* The box in voxels of the tree; 0 if nothing of it is in it. */
static int cut_box(const cm_octree *octree, const gathering *g, cm_walk *walk)
{
    int is_there = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        const double low = floor(g->bounds->least[axis] + g->middle);
        const double high = ceil(g->bounds->greatest[axis] + g->middle);
        const double first = octree->first[axis], beyond = octree->beyond[axis];
        walk->first[axis] = (uint32_t)fmin(fmax(low, first), beyond);
        walk->beyond[axis] = (uint32_t)fmin(fmax(high, first), beyond);
        is_there = is_there && walk->first[axis] < walk->beyond[axis];
    }
    return is_there;
}

cm_status cm_snapshot_make(const cm_octree *octree, const cm_snapshot_bounds *bounds, cm_pool *pool,
                           cm_snapshot *snapshot)
{
    *snapshot =
        (cm_snapshot){.top = -1, .full_top = -1, .middle = (int64_t)1 << (octree->tree_level - 1)};
    for (int i = 0; i < 256; i++)
    {
        snapshot->thickness[i] = i == 255 ? INFINITY : (float)-log2(1.0 - i / 255.0);
    }
    cm_seen_tables(snapshot);
    gathering g = {.snapshot = snapshot,
                   .rule = &octree->rule,
                   .bounds = bounds,
                   .middle = (double)snapshot->middle};
    cm_walk walk = {.only_solid = 1, .user = &g, .even = gather_even, .block = gather_block};
    const cm_status status = cut_box(octree, &g, &walk) ? cm_walk_run(octree, &walk) : CM_OK;
    if (status == CM_ERROR_STOPPED)
    {
        return CM_ERROR_MEMORY;
    }
    if (status != CM_OK || (snapshot->node_count[0] == 0 && snapshot->full_top < 0))
    {
        return status;
    }
    if (snapshot->full_top >= 0 && !end_with_full(&g))
    {
        return CM_ERROR_MEMORY;
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
    *snapshot = (cm_snapshot){.top = -1, .full_top = -1};
}
