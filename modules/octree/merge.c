/* SPDX-License-Identifier: MIT
 *
 * Maps into maps. Where voxels fall on voxels and blocks on blocks, cubes and blocks are added as they are; else each voxel of the
 * one map takes what is at its centre in the other.
 */
#include <math.h>
#include <string.h>

#include "interleave.h"
#include "node_tree.h"
#include "paging.h"
#include "ray_index.h"
#include "walk.h"

/* ---- sums ---- */

static uint8_t sum_of(const cm_count_rule *rule, unsigned a, unsigned b)
{
    const int sum = (int)a + (int)b - CM_UNKNOWN;
    return (uint8_t)(sum < rule->low ? rule->low : sum > rule->high ? rule->high : sum);
}

/* The mean of colors, weighted by hits; one that is none weighs nothing. */
static uint32_t mean_of(uint32_t a, unsigned hits_a, uint32_t b, unsigned hits_b)
{
    if (a == 0 || b == 0)
    {
        return a == 0 ? b : a;
    }
    const uint32_t sum = hits_a + hits_b;
    const uint32_t red = ((a >> 21) * hits_a + (b >> 21) * hits_b + sum / 2) / sum;
    const uint32_t green =
        ((a >> 10 & 2047u) * hits_a + (b >> 10 & 2047u) * hits_b + sum / 2) / sum;
    const uint32_t blue = ((a & 1023u) * hits_a + (b & 1023u) * hits_b + sum / 2) / sum;
    return red << 21 | green << 10 | blue;
}

/* A block of values, one a voxel, and of which detail they are. */
typedef struct added_block
{
    uint8_t alpha[512];
    uint32_t color[512];
    unsigned detail;
    int is_even; /* 1: all have one alpha and no color, and the detail says nothing */
} added_block;

static void make_even(added_block *added, uint8_t alpha)
{
    added->detail = CM_BLOCK_LEVEL;
    added->is_even = 1;
    memset(added->alpha, alpha, sizeof added->alpha);
    memset(added->color, 0, sizeof added->color);
}

static int add_cells(cm_octree *to, cm_region *region, unsigned block, const added_block *added)
{
    const cm_count_rule *rule = &to->rule;
    uint8_t *alpha = cm_block_open(region, block, rule, added->detail);
    if (alpha == NULL)
    {
        return 0;
    }
    const unsigned shift = 3 * region->detail[block];
    int is_solid = 0;
    uint32_t *color = region->color == NULL ? NULL : region->color[block];
    for (unsigned cell = 0; cell < 512u >> shift; cell++)
    {
        const uint8_t more = added->alpha[cell << shift];
        const uint32_t word = to->options.color ? added->color[cell << shift] : 0;
        const uint8_t sum = sum_of(rule, alpha[cell], more);
        if (sum > CM_UNKNOWN && word != 0 && color == NULL)
        {
            color = cm_block_colors(region, block);
            if (color == NULL)
            {
                return 0;
            }
        }
        if (color != NULL)
        {
            const uint32_t old = alpha[cell] > CM_UNKNOWN ? color[cell] : 0;
            color[cell] = sum <= CM_UNKNOWN ? 0
                                            : mean_of(old, cm_hits_of(rule, alpha[cell]), word,
                                                      cm_hits_of(rule, more));
        }
        alpha[cell] = sum;
        is_solid |= sum > CM_UNKNOWN;
    }
    cm_region_mark(region, block, is_solid);
    cm_block_settle(region, block);
    return 1;
}

/* What is even stays so where all of it gets one alpha, as a leaf does. */
static int add_values(cm_octree *to, cm_region *region, unsigned block, const added_block *added)
{
    cm_block_drop_cells(region, block, &to->rule);
    region->changed[block] = to->step;
    if (added->is_even && region->form[block] == CM_BLOCK_EVEN)
    {
        cm_block_even(region, block, sum_of(&to->rule, region->value[block], added->alpha[0]));
        return 1;
    }
    return add_cells(to, region, block, added);
}

static cm_status add_block(cm_octree *to, const uint32_t place[3], const added_block *added)
{
    const uint32_t corner[3] = {place[0] >> CM_REGION_LEVEL << CM_REGION_LEVEL,
                                place[1] >> CM_REGION_LEVEL << CM_REGION_LEVEL,
                                place[2] >> CM_REGION_LEVEL << CM_REGION_LEVEL};
    uint32_t node = 0;
    cm_region *region = NULL;
    cm_status status = cm_node_reach(to, corner, CM_REGION_LEVEL, &node);
    status = status == CM_OK ? cm_node_region(to, node, corner, &region) : status;
    if (status != CM_OK)
    {
        return status;
    }
    to->bytes -= cm_region_size(region);
    const int good =
        add_values(to, region, cm_interleave_3(place[0] >> 3, place[1] >> 3, place[2] >> 3), added);
    to->bytes += cm_region_size(region);
    region->is_dirty = 1;
    return good ? cm_pages_trim(to) : CM_ERROR_MEMORY;
}

/* ---- the same places ---- */

typedef struct merge_work
{
    cm_octree *to;
    const cm_octree *from;
    int64_t shift[3]; /* from places of `from` to places of `to` */
    cm_status status;
    const cm_pose *pose;
} merge_work;

/* To a place of the other map; 0 if it is beyond it. */
static int shifted(const merge_work *work, const uint32_t place[3], uint32_t to[3])
{
    int is_inside = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        const int64_t at = (int64_t)place[axis] + work->shift[axis];
        is_inside &= at >= 0 && at < (int64_t)1 << work->to->tree_level;
        to[axis] = is_inside ? (uint32_t)at : 0;
    }
    return is_inside;
}

static cm_status add_even_region(cm_octree *to, uint32_t node, const uint32_t place[3],
                                 uint8_t alpha)
{
    cm_region *region = NULL;
    cm_status status = cm_node_region(to, node, place, &region);
    if (status != CM_OK)
    {
        return status;
    }
    added_block added;
    make_even(&added, alpha);
    to->bytes -= cm_region_size(region);
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        status = add_values(to, region, block, &added) ? status : CM_ERROR_MEMORY;
    }
    to->bytes += cm_region_size(region);
    region->is_dirty = 1;
    const cm_status trimmed = cm_pages_trim(to);
    return status != CM_OK ? status : trimmed;
}

/* All of a node. */
static cm_status add_to_node(cm_octree *to, uint32_t index, const uint32_t place[3], int level,
                             uint8_t alpha)
{
    cm_node *node = &to->node[index];
    if (node->kind == CM_NODE_LEAF)
    {
        node->value = sum_of(&to->rule, node->value, alpha);
        node->changed = to->step;
        return CM_OK;
    }
    if (node->kind != CM_NODE_INNER)
    {
        return add_even_region(to, index, place, alpha);
    }
    cm_node_push(to, index);
    const uint32_t link = node->link;
    cm_status status = CM_OK;
    for (uint32_t child = 0; status == CM_OK && child < 8; child++)
    {
        uint32_t below[3];
        for (int axis = 0; axis < 3; axis++)
        {
            below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
        }
        status = add_to_node(to, link + child, below, level - 1, alpha);
    }
    return status;
}

/* A cube at a place of the tree of `to`, of which it may not be one, and beyond which it may be. */
static cm_status add_cube(cm_octree *to, const int64_t place[3], int level, uint8_t alpha)
{
    const int64_t length = (int64_t)1 << level, end = (int64_t)1 << to->tree_level;
    int is_beside = 0, is_cube = level <= to->tree_level;
    uint32_t at[3];
    for (int axis = 0; axis < 3; axis++)
    {
        is_beside |= place[axis] + length <= 0 || place[axis] >= end;
        is_cube &= place[axis] >= 0 && place[axis] + length <= end && place[axis] % length == 0;
        at[axis] = is_cube ? (uint32_t)place[axis] : 0;
    }
    if (is_beside)
    {
        return CM_OK;
    }
    if (is_cube && level >= CM_REGION_LEVEL)
    {
        uint32_t node = 0;
        const cm_status status = cm_node_reach(to, at, level, &node);
        return status == CM_OK ? add_to_node(to, node, at, level, alpha) : status;
    }
    if (level == CM_BLOCK_LEVEL)
    {
        added_block added;
        make_even(&added, alpha);
        return is_cube ? add_block(to, at, &added) : CM_OK;
    }
    cm_status status = CM_OK;
    for (int child = 0; status == CM_OK && child < 8; child++)
    {
        const int64_t below[3] = {place[0] + (child & 1 ? length / 2 : 0),
                                  place[1] + (child & 2 ? length / 2 : 0),
                                  place[2] + (child & 4 ? length / 2 : 0)};
        status = add_cube(to, below, level - 1, alpha);
    }
    return status;
}

static int add_even(void *user, const uint32_t place[3], int level, uint8_t alpha)
{
    merge_work *work = user;
    int64_t at[3];
    for (int axis = 0; axis < 3; axis++)
    {
        at[axis] = (int64_t)place[axis] + work->shift[axis];
    }
    work->status = alpha == CM_UNKNOWN ? CM_OK : add_cube(work->to, at, level, alpha);
    return work->status != CM_OK;
}

static void expand(const cm_octree *octree, const cm_region *region, unsigned block,
                   unsigned misses, added_block *added)
{
    uint8_t alpha[512];
    uint32_t color[512];
    added->detail = cm_block_read(region, block, &octree->rule, misses, alpha, color);
    for (unsigned cell = 0; cell < 512; cell++)
    {
        added->alpha[cell] = alpha[cell >> 3 * added->detail];
        added->color[cell] = color[cell >> 3 * added->detail];
    }
}

static void block_place(const cm_region *region, unsigned block, uint32_t place[3])
{
    unsigned in[3];
    cm_divide_3(block, in);
    for (int axis = 0; axis < 3; axis++)
    {
        place[axis] = region->place[axis] + 8 * in[axis];
    }
}

static int add_same_block(void *user, const cm_region *region, unsigned block, unsigned misses)
{
    merge_work *work = user;
    uint32_t place[3], at[3];
    block_place(region, block, place);
    if (!shifted(work, place, at))
    {
        return 0;
    }
    added_block added;
    added.is_even = 0;
    expand(work->from, region, block, misses, &added);
    work->status = add_block(work->to, at, &added);
    return work->status != CM_OK;
}

/* ---- other places ---- */

/* A point of the world of `to` in that of `from`. */
static void to_from(const merge_work *work, const double world[3], double in_from[3])
{
    memcpy(in_from, world, 3 * sizeof *in_from);
    if (work->pose != NULL)
    {
        cm_pose_apply(work->pose, world, in_from);
    }
}

/* A box of voxels of `from`, and what was found in it. */
typedef struct even_box
{
    uint32_t first[3];
    uint32_t beyond[3];
    int looks_into_regions;
    int has_region; /* 1: there was one */
    int alpha;      /* of all that was looked at; below 0: nothing was */
    cm_status status;
} even_box;

static int is_like(even_box *box, uint8_t alpha)
{
    box->alpha = box->alpha < 0 ? alpha : box->alpha;
    return box->alpha == alpha;
}

static int is_region_even(const cm_octree *from, even_box *box, const cm_region *region,
                          unsigned misses)
{
    int is_even = 1;
    for (unsigned block = 0; is_even && block < CM_REGION_BLOCKS; block++)
    {
        uint32_t place[3];
        block_place(region, block, place);
        if (cm_box_meets(box->first, box->beyond, place, CM_BLOCK_LEVEL))
        {
            uint8_t alpha;
            is_even =
                cm_block_is_even(region, block, &from->rule, misses, &alpha) && is_like(box, alpha);
        }
    }
    return is_even;
}

/* Has the part of a node in the box one alpha, that of what was looked at before? */
static int is_node_even(const cm_octree *from, even_box *box, uint32_t index,
                        const uint32_t place[3], int level, unsigned misses)
{
    const cm_node *node = &from->node[index];
    if (!cm_box_meets(box->first, box->beyond, place, level))
    {
        return 1;
    }
    if (node->kind == CM_NODE_LEAF)
    {
        return is_like(box, cm_after_misses(&from->rule, node->value, misses));
    }
    const unsigned more = cm_more_misses(misses, node->value);
    if (node->kind != CM_NODE_INNER)
    {
        const cm_region *region = NULL;
        box->has_region = 1;
        box->status = box->looks_into_regions ? cm_node_look(from, index, place, &region) : CM_OK;
        return region != NULL && is_region_even(from, box, region, more);
    }
    const uint32_t link = node->link;
    int is_even = 1;
    for (uint32_t child = 0; is_even && child < 8; child++)
    {
        uint32_t below[3];
        for (int axis = 0; axis < 3; axis++)
        {
            below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
        }
        is_even = is_node_even(from, box, link + child, below, level - 1, more);
    }
    return is_even;
}

/* What points of the world of `from` are off by, at most: some roundings of each number that they and their places are made of. */
static double rounding_of(const merge_work *work, const double world[3])
{
    const cm_octree_options *from = &work->from->options;
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        sum += fabs(world[axis]) + fabs(from->centre[axis]) +
               (work->pose == NULL ? 0.0 : fabs(work->pose->position[axis]));
    }
    return 0x1p-46 * (sum + ldexp(from->edge, work->from->tree_level));
}

/* The voxels of `from` that the centres of a cube of `to` may fall on. Sets whether some may be beyond it. 0: all are. */
static int box_of(const merge_work *work, const uint32_t place[3], int level, even_box *box,
                  int *is_beyond)
{
    const double last = ldexp(1.0, level) - 0.5;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (unsigned corner = 0; corner < 8; corner++)
    {
        double world[3], at[3];
        for (int axis = 0; axis < 3; axis++)
        {
            world[axis] =
                cm_place_world(work->to, axis, place[axis] + (corner >> axis & 1u ? last : 0.5));
        }
        to_from(work, world, at);
        const double more = rounding_of(work, world);
        for (int axis = 0; axis < 3; axis++)
        {
            low[axis] = fmin(low[axis], cm_world_place(work->from, axis, at[axis] - more));
            high[axis] = fmax(high[axis], cm_world_place(work->from, axis, at[axis] + more) + 1.0);
        }
    }
    *is_beyond = 0;
    for (int axis = 0; axis < 3; axis++)
    {
        const double first = work->from->first[axis], beyond = work->from->beyond[axis];
        if (!(low[axis] < beyond && high[axis] > first))
        {
            return 0;
        }
        *is_beyond |= low[axis] < first || high[axis] > beyond;
        box->first[axis] = (uint32_t)fmax(low[axis], first);
        box->beyond[axis] = (uint32_t)fmin(high[axis], beyond);
    }
    return 1;
}

/* The alpha that all centres of a cube of `to` find in `from`; below 0: more than one, perhaps. */
static int find_even(merge_work *work, const uint32_t place[3], int level, even_box *box)
{
    const uint32_t root[3] = {0, 0, 0};
    int is_beyond = 0;
    if (!box_of(work, place, level, box, &is_beyond))
    {
        return CM_UNKNOWN;
    }
    box->alpha = is_beyond ? CM_UNKNOWN : -1;
    const int is_even = is_node_even(work->from, box, 0, root, work->from->tree_level, 0);
    work->status = box->status;
    return is_even ? box->alpha : -1;
}

static int even_alpha(merge_work *work, const uint32_t place[3], int level)
{
    even_box box = {.looks_into_regions = level <= CM_REGION_LEVEL, .status = CM_OK};
    return find_even(work, place, level, &box);
}

/* What a region that the border of even cubes falls across costs, where an even one costs 1. */
#define BORDER_COST 8

/* Takes from *left what the even cubes of `from` and their borders cost in `to`. A border may be of a cube of 2^19 voxels, whose
 * regions no memory has room for. What has regions in `from`, too, has room. */
static void count_borders(merge_work *work, const uint32_t place[3], int level, uint32_t *left)
{
    even_box box = {.looks_into_regions = 0, .status = CM_OK};
    const int alpha = find_even(work, place, level, &box);
    if (alpha >= 0 || level == CM_REGION_LEVEL)
    {
        const uint32_t cost = alpha >= 0 ? alpha != CM_UNKNOWN : box.has_region ? 0 : BORDER_COST;
        *left = *left > cost ? *left - cost : 0;
        return;
    }
    for (unsigned child = 0; *left > 0 && child < 8; child++)
    {
        uint32_t below[3];
        for (int axis = 0; axis < 3; axis++)
        {
            below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
        }
        count_borders(work, below, level - 1, left);
    }
}

/* What is at a point of the world of `to` in `from`. */
static uint8_t sample(merge_work *work, const double world[3], uint32_t *color)
{
    const cm_octree *from = work->from;
    double in_from[3];
    uint32_t place[3];
    *color = 0;
    to_from(work, world, in_from);
    for (int axis = 0; axis < 3; axis++)
    {
        const double at = cm_world_place(from, axis, in_from[axis]);
        if (!(at >= from->first[axis] && at < from->beyond[axis]))
        {
            return CM_UNKNOWN;
        }
        place[axis] = (uint32_t)at;
    }
    const cm_spot spot = cm_node_find(from, place);
    const cm_node *node = &from->node[spot.node];
    const cm_region *region = NULL;
    if (node->kind == CM_NODE_LEAF)
    {
        return cm_after_misses(&from->rule, node->value, spot.misses);
    }
    const cm_status status = cm_node_look(from, spot.node, place, &region);
    if (status != CM_OK)
    {
        work->status = status;
        return CM_UNKNOWN;
    }
    return cm_block_cell(region, cm_interleave_3(place[0] >> 3, place[1] >> 3, place[2] >> 3),
                         &from->rule, spot.misses, cm_interleave_3(place[0], place[1], place[2]),
                         color);
}

static cm_status add_sampled(merge_work *work, const uint32_t place[3])
{
    added_block added = {.detail = 0};
    int is_known = 0;
    for (unsigned cell = 0; cell < 512; cell++)
    {
        unsigned in[3];
        double world[3];
        int is_own = 1;
        cm_divide_3(cell, in);
        for (int axis = 0; axis < 3; axis++)
        {
            const uint32_t at = place[axis] + in[axis];
            is_own &= at >= work->to->first[axis] && at < work->to->beyond[axis];
            world[axis] = cm_place_world(work->to, axis, at + 0.5);
        }
        added.alpha[cell] = is_own ? sample(work, world, &added.color[cell]) : CM_UNKNOWN;
        is_known |= added.alpha[cell] != CM_UNKNOWN;
    }
    return work->status != CM_OK ? work->status
           : is_known            ? add_block(work->to, place, &added)
                                 : CM_OK;
}

/* A cube of `to` at once where all of it finds one alpha, else its parts, down to blocks: what is even may be larger than could
 * ever be asked voxel by voxel. */
static cm_status add_other_places(merge_work *work, const uint32_t place[3], int level)
{
    const int alpha = even_alpha(work, place, level);
    if (work->status != CM_OK || alpha == CM_UNKNOWN)
    {
        return work->status;
    }
    if (alpha >= 0 && cm_box_has(work->to->first, work->to->beyond, place, level))
    {
        const int64_t at[3] = {place[0], place[1], place[2]};
        return add_cube(work->to, at, level, (uint8_t)alpha);
    }
    if (level == CM_BLOCK_LEVEL)
    {
        return add_sampled(work, place);
    }
    cm_status status = CM_OK;
    for (unsigned child = 0; status == CM_OK && child < 8; child++)
    {
        uint32_t below[3];
        for (int axis = 0; axis < 3; axis++)
        {
            below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
        }
        status = add_other_places(work, below, level - 1);
    }
    return status;
}

/* ---- maps ---- */

/* Borders of 2^21 regions take some 80 GB. */
#define COST_MOST ((uint32_t)BORDER_COST << 21)

/* Do voxels fall on voxels and blocks on blocks? */
static int are_aligned(merge_work *work)
{
    const cm_octree *to = work->to, *from = work->from;
    int aligned = work->pose == NULL && to->options.edge == from->options.edge &&
                  to->options.levels >= CM_REGION_LEVEL && from->options.levels >= CM_REGION_LEVEL;
    for (int axis = 0; axis < 3; axis++)
    {
        const double away =
            (from->options.centre[axis] - to->options.centre[axis]) / to->options.edge;
        const double whole = floor(away + 0.5);
        aligned &= fabs(away - whole) < 1e-6 && fabs(whole) < 1e15 && fmod(whole, 64.0) == 0.0;
        work->shift[axis] = aligned ? (int64_t)whole + ((int64_t)1 << (to->tree_level - 1)) -
                                          ((int64_t)1 << (from->tree_level - 1))
                                    : 0;
    }
    return aligned;
}

/* Cubes of a wider root may be around all of the other. */
static int is_wider(const cm_octree *to, const cm_octree *from)
{
    return from->tree_level > to->tree_level;
}

/* Can all of it be in memory? With pages it need not. Where the roots' centres are one, cubes are added to cubes. */
static int has_room(merge_work *work, int are_same_places)
{
    const uint32_t root[3] = {0, 0, 0};
    const int64_t inside =
        ((int64_t)1 << (work->to->tree_level - 1)) - ((int64_t)1 << (work->from->tree_level - 1));
    uint32_t left = COST_MOST;
    int are_cubes = are_same_places;
    for (int axis = 0; axis < 3; axis++)
    {
        are_cubes &= work->shift[axis] == inside;
    }
    if (!are_cubes && work->to->options.pages == NULL)
    {
        count_borders(work, root, work->to->tree_level, &left);
    }
    return left > 0;
}

cm_status cm_octree_merge(cm_octree *to, const cm_octree *from, const cm_pose *pose)
{
    if (to == NULL || from == NULL || to == from)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = pose == NULL ? CM_OK : cm_pose_check(pose);
    if (status != CM_OK)
    {
        return status;
    }
    if (memcmp(&to->rule, &from->rule, sizeof to->rule) != 0)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    merge_work work = {.to = to, .from = from, .pose = pose, .status = CM_OK};
    const int is_same = are_aligned(&work) && !is_wider(to, from);
    if (!has_room(&work, is_same))
    {
        return CM_ERROR_MEMORY;
    }
    cm_walk walk = {.user = &work, .even = add_even, .block = add_same_block};
    cm_walk_all(from, &walk);
    cm_ray_index_forget(to);
    to->step++;
    to->clock++;
    if (is_same)
    {
        status = cm_walk_run(from, &walk);
        status = status == CM_ERROR_STOPPED ? work.status : status;
    }
    else
    {
        const uint32_t root[3] = {0, 0, 0};
        status = add_other_places(&work, root, to->tree_level);
    }
    return status;
}
