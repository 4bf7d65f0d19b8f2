/* SPDX-License-Identifier: MIT
 *
 * A region in front of a straight camera: its blocks are classified together, then groups of 64 voxels of those that a surface
 * may be in, then their voxels one by one.
 */
#include "update_desk.h"

#include <math.h>
#include <string.h>

#include "interleave.h"

/* ---- details ---- */

unsigned cm_update_detail(const cm_update *update, cm_region *region, unsigned block, double edges)
{
    unsigned detail = 0;
    while (detail + 1 < cm_update_details(update->octree) && (double)(1u << detail) < edges)
    {
        detail++;
    }
    if (detail > region->detail[block])
    {
        cm_block_drop_cells(region, block, &update->octree->rule);
    }
    const int is_even = region->form[block] == CM_BLOCK_EVEN;
    return is_even || detail < region->detail[block] ? detail : region->detail[block];
}

/* ---- voxels ---- */

/* What blocks wait for while theirs is on its way from memory. */
#define BLOCKS_WAITING 2

typedef struct waiting_block
{
    unsigned block;
    int is_changed;
    cm_block_change change;
} waiting_block;

typedef struct block_work
{
    float first[3];             /* the first voxel's centre, in the camera's axes */
    const uint8_t *group_class; /* of eight groups */
    const cm_cube_bounds *bounds;
    const uint32_t *color; /* of an open block; NULL: none yet */
    int is_fetched;        /* 1: colors of pixels are on their way for the whole region */
    cm_ray_ends ends;
} block_work;

/* Those of a block that are visited. */
typedef struct visited_groups
{
    size_t count;
    unsigned number[CM_BLOCK_GROUPS];
    cm_visited_group group[CM_BLOCK_GROUPS];
} visited_groups;

static void first_voxel(const cm_update *update, const uint32_t place[3], unsigned block,
                        float first[3])
{
    unsigned at[3];
    cm_divide_3(block, at);
    double in_tree[3], in_camera[3];
    for (int axis = 0; axis < 3; axis++)
    {
        in_tree[axis] = (double)place[axis] + 8.0 * at[axis];
    }
    cm_update_place(update, in_tree, in_camera);
    for (int axis = 0; axis < 3; axis++)
    {
        first[axis] = (float)in_camera[axis];
    }
}

/* What hits will need: colors of a group's cells, if there are any, and those of pixels that are not fetched for the region. */
static void fetch_colors(const cm_update *update, int is_fetched, const uint32_t *color,
                         uint64_t hits, const int32_t pixel[64])
{
    for (size_t line = 0; color != NULL && line < 64; line += 16)
    {
        if (hits >> line & 0xffffu)
        {
            __builtin_prefetch(color + line, 1);
        }
    }
    hits &= ~(hits << 1 & 0xaaaaaaaaaaaaaaaau); /* of neighbours one: the other's is close by */
    for (; !is_fetched && hits != 0; hits &= hits - 1)
    {
        __builtin_prefetch(update->hit.word + pixel[__builtin_ctzll(hits)]);
    }
}

/* A group that is to be visited comes to a list; nothing happens to one that does not, or all of it is missed. */
static void list_group(const cm_update *update, const block_work *work, unsigned detail,
                       unsigned group, cm_block_change *change, visited_groups *list)
{
    const unsigned class_of = detail == 0 ? work->group_class[group] : (unsigned)CM_CUBE_PART;
    if (cm_update_is_left_out(update, class_of))
    {
        return;
    }
    if (class_of == CM_CUBE_FREE)
    {
        change->misses[group] = ~(uint64_t)0;
        return;
    }
    const cm_cell_offsets *offset = &update->offset[detail];
    list->number[list->count] = group;
    list->group[list->count++] = (cm_visited_group){
        .first = work->first,
        .x = offset->x + 64 * group,
        .y = offset->y + 64 * group,
        .z = offset->z + 64 * group,
        .scale = (float)(1u << detail),
        .is_inside = class_of == CM_CUBE_BAND,
        .is_front = class_of == CM_CUBE_FRONT,
        .bounds = detail == 0 ? work->bounds[group] : (cm_cube_bounds){-INFINITY, INFINITY},
        .hits = &change->hits[group],
        .misses = &change->misses[group],
        .pixel = change->pixel[group]};
}

/* Hits and misses of a block's groups. */
static void visit_groups(const cm_update *update, const block_work *work, unsigned detail,
                         cm_block_change *change)
{
    visited_groups list;
    list.count = 0;
    for (unsigned group = 0; group * 64 < cm_cell_count(detail); group++)
    {
        list_group(update, work, detail, group, change, &list);
    }
    update->set->visit(&update->desk->view.table, list.count, list.group);
    for (size_t i = 0; update->has_color && i < list.count; i++)
    {
        const unsigned group = list.number[i];
        if (change->hits[group] != 0)
        {
            fetch_colors(update, work->is_fetched,
                         work->color == NULL ? NULL : work->color + 64 * group, change->hits[group],
                         change->pixel[group]);
        }
    }
}

/* A block is on its way from memory while the next ones are worked on. */
static void fetch(const cm_region *region, unsigned block)
{
    const uint8_t *alpha = region->alpha[block];
    for (size_t line = 0; alpha != NULL && line < cm_cell_count(region->detail[block]); line += 64)
    {
        __builtin_prefetch(alpha + line, 1);
    }
}

static void visit_block(cm_update *update, cm_region *region, const block_work *work,
                        unsigned detail, waiting_block *to)
{
    const unsigned block = to->block;
    cm_block_change *change = &to->change;
    change->detail = detail;
    memset(change->hits, 0, sizeof change->hits);
    memset(change->misses, 0, sizeof change->misses);
    const size_t cells = cm_cell_count(detail);
    const uint64_t all = cells < 64 ? ((uint64_t)1 << cells) - 1 : ~(uint64_t)0;
    const int is_whole = cm_update_is_within(update->octree, region, block);
    uint64_t any = 0, every_miss = all;
    visit_groups(update, work, detail, change);
    if (detail == 0) /* coarser cells are large enough for their own pixel */
    {
        cm_ray_ends_hit(work->ends, change->hits, change->pixel);
    }
    for (unsigned group = 0; group * 64 < cells; group++)
    {
        const uint64_t valid =
            is_whole ? all : cm_update_valid(update->octree, region, block, detail, group) & all;
        change->hits[group] &= valid;
        change->misses[group] &=
            update->octree->options.endpoints_only ? 0 : valid & ~change->hits[group];
        any |= change->hits[group] | change->misses[group];
        every_miss &= change->misses[group];
    }
    to->is_changed = any != 0;
    if (every_miss == all && region->form[block] == CM_BLOCK_EVEN)
    {
        cm_update_free_block(update, region, block);
        to->is_changed = 0;
    }
    else if (any != 0)
    {
        fetch(region, block);
    }
}

static void change_block(cm_update *update, cm_region *region, waiting_block *from)
{
    if (from->is_changed && !cm_update_block(update, region, from->block, &from->change))
    {
        update->failed = 1;
    }
    from->is_changed = 0;
}

/* ---- a region ---- */

/* The centres of blocks, then of groups, in the camera's axes; arrays have room for 4096. */
typedef struct cube_places
{
    float x[CM_REGION_GROUPS];
    float y[CM_REGION_GROUPS];
    float z[CM_REGION_GROUPS];
    uint8_t class_of[CM_REGION_GROUPS];
    cm_cube_bounds bounds[CM_REGION_GROUPS];
} cube_places;

/* Cubes of eight blocks. */
static void classify_eights(const cm_update *update, const float first[3], cube_places *places)
{
    const cm_cell_offsets *of = &update->block;
    for (unsigned eight = 0; eight < CM_REGION_BLOCKS / 8; eight++)
    {
        const unsigned low = 8 * eight, high = low + 7;
        places->x[eight] = first[0] + 0.5f * (of->x[low] + of->x[high]);
        places->y[eight] = first[1] + 0.5f * (of->y[low] + of->y[high]);
        places->z[eight] = first[2] + 0.5f * (of->z[low] + of->z[high]);
    }
    update->set->classify(&update->desk->view.table, CM_REGION_BLOCKS / 8, places->x, places->y,
                          places->z, update->eight_half, places->class_of, NULL);
}

/* Bits of the blocks of a region. */
typedef struct block_bits
{
    uint64_t word[CM_REGION_BLOCKS / 64];
} block_bits;

static block_bits blocks_of(cm_ray_ends ends)
{
    block_bits bits = {{0}};
    for (const cm_ray_end *end = ends.first; end != ends.end; end++)
    {
        bits.word[end->key >> 15 & 7u] |= (uint64_t)1 << (end->key >> 9 & 63u);
    }
    return bits;
}

static int has_eight(const block_bits *bits, unsigned eight)
{
    return (bits->word[eight / 8] >> 8 * (eight % 8) & 255u) != 0;
}

static int has_block(const block_bits *bits, unsigned block)
{
    return (int)(bits->word[block / 64] >> block % 64 & 1u);
}

/* Blocks in which something may happen, in their order, and how many; and their classes, and Z of their centres. In those that rays
 * end in it may, wherever their centres are. */
static size_t classify_blocks(const cm_update *update, const uint32_t place[3],
                              const block_bits *ended, cube_places *places,
                              uint16_t listed[CM_REGION_BLOCKS + 1],
                              uint8_t class_of[CM_REGION_BLOCKS], float z[CM_REGION_BLOCKS])
{
    float first[3];
    first_voxel(update, place, 0, first);
    classify_eights(update, first, places);
    size_t count = 0;
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        listed[count] = (uint16_t)block;
        count += has_eight(ended, block / 8) ||
                 !cm_update_is_left_out(update, places->class_of[block / 8]);
    }
    for (size_t i = 0; i < count; i++)
    {
        places->x[i] = first[0] + update->block.x[listed[i]];
        places->y[i] = first[1] + update->block.y[listed[i]];
        places->z[i] = z[i] = first[2] + update->block.z[listed[i]];
    }
    for (size_t i = count; i % 16 != 0; i++)
    {
        places->x[i] = places->y[i] = places->z[i] = 0.0f;
    }
    update->set->classify(&update->desk->view.table, count, places->x, places->y, places->z,
                          update->block_half, class_of, NULL);
    for (size_t i = 0; i < count; i++)
    {
        class_of[i] = has_block(ended, listed[i]) ? (uint8_t)CM_CUBE_PART : class_of[i];
    }
    return count;
}

/* Groups of the listed blocks; first has their first voxels. */
static void classify_groups(const cm_update *update, size_t count, const float (*first)[3],
                            cube_places *places)
{
    const cm_cell_offsets *offset =
        &update->offset[2]; /* cells of 4^3 voxels are those of detail 2 */
    const float *const of[3] = {offset->x, offset->y, offset->z};
    float *const to[3] = {places->x, places->y, places->z};
    for (int axis = 0; axis < 3; axis++)
    {
        float aside[8]; /* what is written may be read, as far as compilers know */
        memcpy(aside, of[axis], sizeof aside);
        for (size_t i = 0; i < count; i++)
        {
            const float from = first[i][axis];
            for (size_t group = 0; group < 8; group++)
            {
                to[axis][8 * i + group] = from + aside[group];
            }
        }
    }
    for (size_t i = 8 * count; i % 16 != 0; i++)
    {
        places->x[i] = places->y[i] = places->z[i] = 0.0f;
    }
    update->set->classify(&update->desk->view.table, 8 * count, places->x, places->y, places->z,
                          update->group_half, places->class_of, places->bounds);
}

static const uint32_t *open_colors(const cm_region *region, unsigned block)
{
    return region->color != NULL && region->form[block] == CM_BLOCK_PLAIN &&
                   region->detail[block] == 0
               ? region->color[block]
               : NULL;
}

/* No more pixels are fetched for a region: they would drive each other out of what is near. */
#define FETCHED_MOST 40000.0

/* And no more colors of pixels: in larger regions few are of hits. */
#define FETCHED_COLORS 20000.0

/* Pixels that a region falls on are on their way, too: what they say is met in no order that processors know. 1: and their
 * colors. */
static int fetch_pixels(const cm_update *update, const cm_region *region)
{
    const cm_view_table *table = &update->desk->view.table;
    double place[3], centre[3];
    float half[3];
    for (int axis = 0; axis < 3; axis++)
    {
        place[axis] = (double)region->place[axis] + 31.5;
    }
    cm_update_place(update, place, centre);
    cm_update_half(update, CM_REGION_LEVEL, 0.0, half);
    const double nearest = centre[2] - (double)half[2];
    if (!(nearest > 0.0))
    {
        return 0;
    }
    double first[2], last[2];
    const double size[2] = {table->width - 1.0, table->height - 1.0};
    for (int axis = 0; axis < 2; axis++)
    {
        const double focal = fabs((double)table->focal[axis]);
        const double middle =
            (double)table->focal[axis] * centre[axis] / centre[2] + (double)table->centre[axis];
        const double wide = focal * (double)half[axis] / centre[2] * 0.8; /* most of it is enough */
        first[axis] = middle - wide > 0.0 ? middle - wide : 0.0;
        last[axis] = middle + wide < size[axis] ? middle + wide : size[axis];
    }
    const double pixels = (last[0] - first[0]) * (last[1] - first[1]);
    const int has_colors = update->has_color && pixels <= FETCHED_COLORS;
    if (pixels > FETCHED_MOST)
    {
        return 0;
    }
    for (uint32_t row = (uint32_t)first[1]; (double)row <= last[1]; row++)
    {
        for (uint32_t column = (uint32_t)first[0]; (double)column <= last[0]; column += 8)
        {
            __builtin_prefetch(table->rule + (size_t)row * table->stride + column, 0, 2);
        }
        for (uint32_t column = (uint32_t)first[0]; has_colors && (double)column <= last[0];
             column += 16)
        {
            __builtin_prefetch(update->hit.word + (size_t)row * table->stride + column, 0, 2);
        }
    }
    return has_colors;
}

int cm_update_may_change(const cm_update *update, const uint32_t place[3], uint8_t alpha)
{
    cube_places places;
    uint8_t class_of[CM_REGION_BLOCKS];
    float z[CM_REGION_BLOCKS];
    uint16_t listed[CM_REGION_BLOCKS + 1];
    const block_bits none = {{0}};
    const size_t count = classify_blocks(update, place, &none, &places, listed, class_of, z);
    const int is_lowest = cm_after_misses(&update->octree->rule, alpha, 1) == alpha;
    int may_change = 0;
    for (size_t i = 0; i < count; i++)
    {
        may_change |= !cm_update_is_left_out(update, class_of[i]) &&
                      !(class_of[i] == CM_CUBE_FREE && is_lowest);
    }
    return may_change;
}

/* The blocks that are looked at voxel by voxel, in the order of their numbers. */
typedef struct chosen_blocks
{
    size_t count;
    uint16_t listed[CM_REGION_BLOCKS + 1];
    float z[CM_REGION_BLOCKS];
    float first[CM_REGION_BLOCKS][3];
} chosen_blocks;

/* Misses change nothing of a block that is wholly at the lowest, and at the picture's border nothing else happens in what is in front
 * of all. Coarser cells are hit from farther away. */
static int is_missed_already(const cm_update *update, cm_region *region, unsigned block,
                             unsigned class_of, float z)
{
    return class_of == CM_CUBE_FRONT && region->form[block] == CM_BLOCK_EVEN &&
           region->value[block] == update->octree->rule.low &&
           cm_update_detail(update, region, block, update->pixel * (double)z) == 0;
}

/* Chooses them; those that are wholly free are counted as such at once. */
static void choose_blocks(cm_update *update, cm_region *region, const block_bits *ended,
                          cube_places *places, chosen_blocks *chosen)
{
    uint8_t class_of[CM_REGION_BLOCKS];
    const size_t classified =
        classify_blocks(update, region->place, ended, places, chosen->listed, class_of, chosen->z);
    chosen->count = 0;
    for (size_t i = 0; i < classified; i++)
    {
        const unsigned block = chosen->listed[i];
        if (cm_update_is_left_out(update, class_of[i]))
        {
            continue;
        }
        if (class_of[i] == CM_CUBE_FREE && cm_update_is_within(update->octree, region, block))
        {
            cm_update_free_block(update, region, block);
        }
        else if (!is_missed_already(update, region, block, class_of[i], chosen->z[i]))
        {
            first_voxel(update, region->place, block, chosen->first[chosen->count]);
            chosen->z[chosen->count] = chosen->z[i];
            chosen->listed[chosen->count++] = (uint16_t)block;
        }
    }
}

static void visit_blocks(cm_update *update, cm_region *region, const cube_places *places,
                         const chosen_blocks *chosen, int is_fetched, cm_ray_ends ends)
{
    waiting_block waiting[BLOCKS_WAITING];
    for (size_t i = 0; i < BLOCKS_WAITING; i++)
    {
        waiting[i].is_changed = 0;
    }
    for (size_t i = 0; i < chosen->count; i++)
    {
        const uint16_t block = chosen->listed[i];
        waiting_block *next = &waiting[i % BLOCKS_WAITING];
        change_block(update, region, next);
        next->block = block;
        block_work work = {.group_class = places->class_of + 8 * i,
                           .bounds = places->bounds + 8 * i,
                           .color = open_colors(region, block),
                           .is_fetched = is_fetched,
                           .ends = cm_ray_ends_take_block(&ends, block)};
        memcpy(work.first, chosen->first[i], sizeof work.first);
        visit_block(update, region, &work,
                    cm_update_detail(update, region, block, update->pixel * (double)chosen->z[i]),
                    next);
    }
    for (size_t i = 0; i < BLOCKS_WAITING; i++)
    {
        change_block(update, region, &waiting[i]);
    }
}

void cm_update_region(cm_update *update, cm_region *region)
{
    cube_places places;
    chosen_blocks chosen;
    const int is_fetched = fetch_pixels(update, region);
    const cm_ray_ends ends = cm_ray_ends_in(update->ends, region->place, CM_REGION_LEVEL);
    const block_bits ended = blocks_of(ends);
    choose_blocks(update, region, &ended, &places, &chosen);
    classify_groups(update, chosen.count, (const float(*)[3])chosen.first, &places);
    visit_blocks(update, region, &places, &chosen, is_fetched, ends);
    region->is_dirty = 1;
}
