/* SPDX-License-Identifier: MIT
 *
 * The nearest occupied voxel: cubes in the order of their distance, as far as nothing nearer was found.
 */
#include <math.h>

#include "interleave.h"
#include "node_tree.h"
#include "paging.h"
#include "walk.h"

typedef struct nearest_work
{
    const cm_octree *octree;
    double at[3]; /* voxels of the tree */
    double best;  /* squared distance in voxels; nothing farther is wanted */
    uint64_t key; /* of the best */
    int is_found;
    int failed; /* 1: pages, in which a nearer one may be */
    uint32_t place[3];
    unsigned detail;
    uint8_t alpha;
    uint32_t color;
} nearest_work;

/* The squared distance from the point to the nearest centre of a voxel of level 0 in a cube. */
static double least_distance(const nearest_work *work, const uint32_t place[3], int level)
{
    double square = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        const double low = place[axis] + 0.5, high = place[axis] + ldexp(1.0, level) - 0.5;
        const double at = work->at[axis];
        const double away = at < low ? low - at : at > high ? at - high : 0.0;
        square += away * away;
    }
    return square;
}

static void take(nearest_work *work, const uint32_t place[3], int level, uint8_t alpha,
                 uint32_t color)
{
    /* the nearest voxel of a cube whose voxels are alike */
    uint32_t nearest[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const double low = place[axis], high = place[axis] + ldexp(1.0, level) - 1.0;
        const double at = ceil(work->at[axis]) - 1.0; /* of two as near the first */
        nearest[axis] = (uint32_t)(at < low ? low : at > high ? high : at);
    }
    const double square = least_distance(work, nearest, 0);
    const uint64_t key = cm_interleave(nearest);
    if (alpha > CM_UNKNOWN &&
        (square < work->best || (square == work->best && (!work->is_found || key < work->key))))
    {
        work->best = square;
        work->key = key;
        work->is_found = 1;
        work->alpha = alpha;
        work->color = color;
        for (int axis = 0; axis < 3; axis++)
        {
            work->place[axis] = nearest[axis];
        }
    }
}

static void search_block(nearest_work *work, const cm_region *region, unsigned block,
                         unsigned misses)
{
    uint8_t alpha[512];
    uint32_t color[512];
    const unsigned detail = cm_block_read(region, block, &work->octree->rule, misses, alpha, color);
    unsigned at[3];
    cm_divide_3(block, at);
    for (unsigned cell = 0; cell < cm_cell_count(detail); cell++)
    {
        unsigned in[3];
        cm_divide_3(cell << 3 * detail, in);
        const uint32_t place[3] = {region->place[0] + 8 * at[0] + in[0],
                                   region->place[1] + 8 * at[1] + in[1],
                                   region->place[2] + 8 * at[2] + in[2]};
        if (alpha[cell] > CM_UNKNOWN)
        {
            take(work, place, (int)detail, alpha[cell], color[cell]);
        }
    }
}

static void search_region(nearest_work *work, const cm_region *region, unsigned misses)
{
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        unsigned in[3];
        cm_divide_3(block, in);
        const uint32_t place[3] = {region->place[0] + 8 * in[0], region->place[1] + 8 * in[1],
                                   region->place[2] + 8 * in[2]};
        if (least_distance(work, place, CM_BLOCK_LEVEL) > work->best)
        {
            continue;
        }
        if (region->form[block] == CM_BLOCK_EVEN)
        {
            take(work, place, CM_BLOCK_LEVEL,
                 cm_after_misses(&work->octree->rule, region->value[block], misses), 0);
        }
        else
        {
            search_block(work, region, block, misses);
        }
    }
}

static void search(nearest_work *work, uint32_t index, const uint32_t place[3], int level,
                   unsigned misses)
{
    const cm_octree *octree = work->octree;
    const cm_node *node = &octree->node[index];
    if (least_distance(work, place, level) > work->best)
    {
        return;
    }
    if (node->kind == CM_NODE_LEAF)
    {
        take(work, place, level, cm_after_misses(&octree->rule, node->value, misses), 0);
        return;
    }
    const unsigned more = cm_more_misses(misses, node->value);
    if (node->kind != CM_NODE_INNER)
    {
        const cm_region *region = NULL;
        if (cm_node_look(octree, index, place, &region) == CM_OK)
        {
            search_region(work, region, more);
        }
        else
        {
            work->failed = 1;
        }
        return;
    }
    /* the child that the point is in or nearest to first */
    unsigned first = 0;
    for (int axis = 0; axis < 3; axis++)
    {
        first |= (unsigned)(work->at[axis] >= place[axis] + ldexp(1.0, level - 1)) << axis;
    }
    for (unsigned i = 0; i < 8; i++)
    {
        const unsigned child = i ^ first;
        uint32_t below[3];
        for (int axis = 0; axis < 3; axis++)
        {
            below[axis] = place[axis] + ((child >> axis & 1u) << (level - 1));
        }
        search(work, node->link + child, below, level - 1, more);
    }
}

int cm_octree_nearest(const cm_octree *octree, const double point[3], double radius,
                      cm_voxel *voxel)
{
    if (octree == NULL || point == NULL || !(radius >= 0.0))
    {
        return 0;
    }
    /* a little more than the radius, whose square is rounded; the distance decides at the end */
    const double voxels = radius / octree->options.edge * (1.0 + 1e-14);
    nearest_work work = {.octree = octree, .best = voxels * voxels};
    const double middle = ldexp(1.0, octree->tree_level - 1);
    for (int axis = 0; axis < 3; axis++)
    {
        work.at[axis] =
            (point[axis] - octree->options.centre[axis]) / octree->options.edge + middle;
        if (!(fabs(work.at[axis]) < 1e15))
        {
            return 0;
        }
    }
    const uint32_t first[3] = {0, 0, 0};
    search(&work, 0, first, octree->tree_level, 0);
    const double distance = sqrt(work.best) * octree->options.edge;
    const int is_within = work.is_found && !work.failed && distance <= radius;
    if (is_within && voxel != NULL)
    {
        *voxel = cm_voxel_at(octree, work.place, 0, work.alpha, work.color);
        voxel->distance = distance;
    }
    return is_within;
}
