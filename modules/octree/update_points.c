/* SPDX-License-Identifier: MIT
 *
 * Points with an origin. Voxels that have a point are hit; those that a ray goes through before its own point's are missed. All
 * are marked before any changes, so that each changes once and a hit goes before a miss.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "modules/memory/checked_size.h"
#include "interleave.h"
#include "paging.h"
#include "point_marks.h"
#include "ray_index.h"
#include "update_desk.h"

/* ---- what each point says ---- */

/* The part of a ray that is within the map; 0 if none is. */
static int cut(const cm_octree *octree, double from[3], double to[3])
{
    double first = 0.0, last = 1.0;
    for (int axis = 0; axis < 3; axis++)
    {
        const double step = to[axis] - from[axis];
        const double low = octree->first[axis], high = octree->beyond[axis] - 1e-6;
        if (step == 0.0)
        {
            last = from[axis] < low || from[axis] > high ? -1.0 : last;
            continue;
        }
        const double a = (low - from[axis]) / step, b = (high - from[axis]) / step;
        first = fmax(first, fmin(a, b));
        last = fmin(last, fmax(a, b));
    }
    if (!(first <= last))
    {
        return 0;
    }
    for (int axis = 0; axis < 3; axis++)
    {
        /* from far away a place is rounded to beyond the map, where rays would go on and on */
        const double step = to[axis] - from[axis];
        const double low = octree->first[axis], high = octree->beyond[axis] - 1e-6;
        to[axis] = fmin(fmax(last < 1.0 ? from[axis] + last * step : to[axis], low), high);
        from[axis] = fmin(fmax(from[axis] + first * step, low), high);
    }
    return 1;
}

/* The voxel of a place of the tree, one before its first if it is far away. */
static void voxel_of(const double at[3], int32_t voxel[3])
{
    for (int axis = 0; axis < 3; axis++)
    {
        voxel[axis] = at[axis] < 1e9 && at[axis] > -1e9 ? (int32_t)floor(at[axis]) : -1;
    }
}

/* Misses along a ray up to the voxel of its end, which is its own. */
static int mark_misses(cm_point_marks *marks, const cm_octree *octree, const double origin[3],
                       const double end[3])
{
    double from[3], to[3];
    int32_t own[3], last[3];
    memcpy(from, origin, sizeof from);
    memcpy(to, end, sizeof to);
    if (!cut(octree, from, to))
    {
        return 1;
    }
    voxel_of(end, own);
    voxel_of(to, last);
    return cm_marks_ray(marks, octree, from, to, memcmp(own, last, sizeof own) == 0);
}

static double middle_of(const cm_octree *octree)
{
    return (double)((uint32_t)1 << (octree->tree_level - 1));
}

static void to_voxels(const cm_octree *octree, const double world[3], double at[3])
{
    for (int axis = 0; axis < 3; axis++)
    {
        at[axis] = CM_PLACE_OF(world[axis], octree->options.centre[axis], octree->options.edge,
                               middle_of(octree));
    }
}

/* What is farther is no point. */
#define FARTHEST 1e100

/* Misses of the ray to a point. */
static int mark_ray(cm_point_marks *marks, const cm_octree *octree, const double origin[3],
                    const float *xyz)
{
    const double point[3] = {(double)xyz[0], (double)xyz[1], (double)xyz[2]};
    double away[3], square = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        away[axis] = point[axis] - origin[axis];
        square += away[axis] * away[axis];
    }
    const double range = sqrt(square), far = octree->options.far;
    if (!(range > 0.0 && range < FARTHEST) || range < octree->options.near)
    {
        return 1;
    }
    const int is_far = far > 0.0 && range > far;
    double end[3], from[3], to[3];
    for (int axis = 0; axis < 3; axis++)
    {
        end[axis] = is_far ? origin[axis] + away[axis] * (far / range) : point[axis];
    }
    to_voxels(octree, end, to);
    to_voxels(octree, origin, from);
    return mark_misses(marks, octree, from, to);
}

/* The least number above 0 whose root is no less than near. */
static double least_square(double near)
{
    double square = fmax(near * near, 0x1p-1074);
    while (square > 0x1p-1074 && sqrt(nextafter(square, 0.0)) >= near)
    {
        square = nextafter(square, 0.0);
    }
    while (sqrt(square) < near)
    {
        square = nextafter(square, INFINITY);
    }
    return square;
}

static cm_point_grid grid_of(const cm_octree *octree, const double origin[3])
{
    const cm_octree_options *options = &octree->options;
    const double far = options->far > 0.0 && options->far < FARTHEST
                           ? nextafter(options->far, INFINITY)
                           : FARTHEST;
    cm_point_grid grid = {.least = least_square(options->near),
                          .most = nextafter(least_square(far), 0.0),
                          .edge = options->edge,
                          .middle = middle_of(octree)};
    for (int axis = 0; axis < 3; axis++)
    {
        grid.origin[axis] = origin[axis];
        grid.centre[axis] = options->centre[axis];
        grid.first[axis] = (double)octree->first[axis];
        grid.beyond[axis] = (double)octree->beyond[axis];
    }
    return grid;
}

/* color may be NULL. */
static int mark_points(cm_point_marks *marks, const cm_octree *octree, const double origin[3],
                       size_t n, const float *xyz, const uint8_t *color)
{
    const cm_point_grid grid = grid_of(octree, origin);
    uint64_t place[1 + CM_POINTS_TOGETHER];
    float rest[3 * CM_POINTS_TOGETHER];
    int good = 1;
    place[CM_POINTS_TOGETHER] = CM_NO_PLACE;
    for (size_t i = 0; good && i < n; i += CM_POINTS_TOGETHER)
    {
        const float *points = xyz + 3 * i;
        if (n - i < CM_POINTS_TOGETHER)
        {
            for (size_t k = 0; k < 3 * CM_POINTS_TOGETHER; k++)
            {
                rest[k] = k < 3 * (n - i) ? points[k] : NAN;
            }
            points = rest;
        }
        place[0] = place[CM_POINTS_TOGETHER];
        const uint64_t bits = octree->set->places(&grid, points, place + 1);
        good = cm_marks_hits(marks, place + 1, bits, color == NULL ? NULL : color + 3 * i);
    }
    for (size_t i = 0; good && !octree->options.endpoints_only && i < n; i++)
    {
        good = mark_ray(marks, octree, origin, xyz + 3 * i);
    }
    return good;
}

/* ---- into the tree ---- */

/* Regions in the order of keys, in which pages like them. */
typedef struct ordered_region
{
    uint64_t key;
    const cm_region_marks *marks;
} ordered_region;

static int in_order(const void *a, const void *b)
{
    const ordered_region *p = a, *q = b;
    return p->key < q->key ? -1 : p->key > q->key;
}

/* Those in which something may change. NULL if there is no memory. */
static ordered_region *order_regions(const cm_octree *octree, const cm_point_marks *marks,
                                     size_t *count)
{
    ordered_region *list = cm_array_of(marks->region_count, sizeof *list);
    *count = 0;
    for (size_t i = 0; list != NULL && i < marks->region_count; i++)
    {
        const cm_region_marks *region = &marks->region[i];
        const cm_spot spot = cm_node_find(octree, region->place);
        const cm_node *node = &octree->node[spot.node];
        const unsigned alpha = node->kind == CM_NODE_LEAF
                                   ? cm_after_misses(&octree->rule, node->value, spot.misses)
                                   : 255;
        if (region->has_hits || cm_after_misses(&octree->rule, alpha, 1) != alpha)
        {
            list[(*count)++] = (ordered_region){cm_interleave(region->place), region};
        }
    }
    if (list != NULL)
    {
        qsort(list, *count, sizeof *list, in_order);
    }
    return list;
}

static cm_status get_region(cm_octree *octree, const uint32_t place[3], cm_region **region)
{
    uint32_t node = 0;
    const cm_status status = cm_node_reach(octree, place, CM_REGION_LEVEL, &node);
    return status == CM_OK ? cm_node_region(octree, node, place, region) : status;
}

/* The change that marks are, and whether there is any. */
static int make_change(const cm_update *update, const cm_region *region, unsigned block,
                       const cm_point_marks *marks, const cm_block_marks *from,
                       cm_block_change *change)
{
    uint64_t any = 0;
    change->detail = 0;
    for (unsigned group = 0; group < 8; group++)
    {
        change->hits[group] = from->hits[group];
        change->misses[group] = from->misses[group] & ~from->hits[group];
        if (change->misses[group] != 0)
        {
            change->misses[group] &= cm_update_valid(update->octree, region, block, 0, group);
        }
        any |= change->hits[group] | change->misses[group];
    }
    for (uint32_t run = from->run; run != 0; run = marks->run[run - 1].before)
    {
        const size_t end = run < marks->run_count ? marks->run[run].first : marks->hit_count;
        for (size_t hit = marks->run[run - 1].first; hit < end; hit++)
        {
            const unsigned cell = marks->cell[hit];
            change->pixel[cell / 64][cell % 64] = (int32_t)hit;
        }
    }
    return any != 0;
}

static int apply_block(cm_update *update, cm_region *region, unsigned block,
                       const cm_point_marks *marks, const cm_block_marks *from)
{
    cm_block_change change;
    if (!make_change(update, region, block, marks, from, &change))
    {
        return 1;
    }
    uint64_t hits = 0, missed = ~(uint64_t)0;
    for (unsigned group = 0; group < 8; group++)
    {
        hits |= change.hits[group];
        missed &= change.misses[group];
    }
    const uint8_t alpha = region->value[block];
    if (hits == 0 && region->form[block] == CM_BLOCK_EVEN)
    {
        if (cm_after_misses(&update->octree->rule, alpha, 1) == alpha)
        {
            return 1; /* it stays even */
        }
        if (missed == ~(uint64_t)0)
        {
            cm_update_free_block(update, region, block);
            return 1;
        }
    }
    return cm_update_block(update, region, block, &change);
}

/* What the hits of a block will be counted in is on its way from memory while others are worked on. */
static void fetch_block(const cm_region *region, unsigned block, const cm_block_marks *from)
{
    const uint8_t *alpha = region->alpha[block];
    const uint32_t *color = region->color == NULL ? NULL : region->color[block];
    for (unsigned group = 0; alpha != NULL && region->detail[block] == 0 && group < 8; group++)
    {
        if (from->hits[group] == 0)
        {
            continue;
        }
        __builtin_prefetch(alpha + 64 * group, 1);
        for (unsigned line = 0; color != NULL && line < 64; line += 16)
        {
            if (from->hits[group] >> line & 0xffffu)
            {
                __builtin_prefetch(color + 64 * group + line, 1);
            }
        }
    }
}

static cm_status apply_region(cm_update *update, const cm_point_marks *marks,
                              const cm_region_marks *from)
{
    cm_octree *octree = update->octree;
    cm_region *region = NULL;
    const cm_status status = get_region(octree, from->place, &region);
    if (status != CM_OK)
    {
        return status;
    }
    octree->bytes -= cm_region_size(region);
    int good = 1;
    const cm_block_marks *waiting = NULL;
    unsigned block_of = 0;
    for (unsigned block = 0; good && block < CM_REGION_BLOCKS; block++)
    {
        if (from->block[block] != 0)
        {
            const cm_block_marks *next = &marks->block[from->block[block] - 1];
            fetch_block(region, block, next);
            good = waiting == NULL || apply_block(update, region, block_of, marks, waiting);
            waiting = next;
            block_of = block;
        }
    }
    good = good && (waiting == NULL || apply_block(update, region, block_of, marks, waiting));
    region->is_dirty = 1;
    octree->bytes += cm_region_size(region);
    return good ? CM_OK : CM_ERROR_MEMORY;
}

/* All regions come into memory first, so that pages that fail leave the map as it was. */
static cm_status apply(cm_octree *octree, const cm_point_marks *marks)
{
    cm_update *update = malloc(sizeof *update);
    size_t count = 0;
    ordered_region *list = update == NULL ? NULL : order_regions(octree, marks, &count);
    cm_status status = list == NULL ? CM_ERROR_MEMORY : CM_OK;
    for (size_t i = 0; status == CM_OK && i < count; i++)
    {
        cm_region *region = NULL;
        status = get_region(octree, list[i].marks->place, &region);
    }
    if (status == CM_OK)
    {
        octree->step++;
        update->octree = octree;
        update->set = octree->set;
        update->hit.word = marks->color;
        update->has_color = marks->color != NULL;
        cm_update_make_parts(update);
    }
    for (size_t i = 0; status == CM_OK && i < count; i++)
    {
        status = apply_region(update, marks, list[i].marks);
    }
    free(update);
    free(list);
    const cm_status trimmed = cm_pages_trim(octree);
    return status != CM_OK ? status : trimmed;
}

cm_status cm_octree_update_points(cm_octree *octree, const double origin[3], size_t n,
                                  const float *xyz, const uint8_t *rgb)
{
    if (octree == NULL || origin == NULL || (xyz == NULL && n > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    for (int axis = 0; axis < 3; axis++)
    {
        if (!(fabs(origin[axis]) < 1e100))
        {
            return CM_ERROR_RANGE;
        }
    }
    const uint8_t *color = octree->options.color ? rgb : NULL;
    cm_point_marks marks = {0};
    cm_status status = mark_points(&marks, octree, origin, n, xyz, color) ? CM_OK : CM_ERROR_MEMORY;
    if (status == CM_OK && marks.region_count > 0)
    {
        cm_ray_index_forget(octree);
        octree->clock++;
        status = apply(octree, &marks);
    }
    cm_marks_clear(&marks);
    return status;
}
