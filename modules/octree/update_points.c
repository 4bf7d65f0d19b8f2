/* SPDX-License-Identifier: MIT
 *
 * Points with an origin. Voxels that have a point are hit; those that a ray goes through before its own point's are missed. Keys
 * of all are sorted, so that each comes once and a hit goes before a miss.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "interleave.h"
#include "node_tree.h"
#include "paging.h"
#include "ray_index.h"
#include "walk.h"

/* A voxel that something happens to: its key, and the point whose hit it is; a miss has none. */
typedef struct voxel_event
{
    uint64_t key;
    uint64_t point;
} voxel_event;

#define NO_POINT UINT64_MAX

typedef struct event_list
{
    voxel_event *event;
    size_t count;
    size_t room;
} event_list;

static int push(event_list *list, const uint32_t place[3], uint64_t point)
{
    if (list->count == list->room)
    {
        const size_t room = list->room == 0 ? 4096 : 2 * list->room;
        voxel_event *more = realloc(list->event, room * sizeof *more);
        if (more == NULL)
        {
            return 0;
        }
        list->event = more;
        list->room = room;
    }
    list->event[list->count++] = (voxel_event){cm_interleave(place), point};
    return 1;
}

/* By key, hits first, in the points' order. */
static int in_order(const void *a, const void *b)
{
    const voxel_event *p = a, *q = b;
    return p->key != q->key      ? (p->key < q->key ? -1 : 1)
           : p->point < q->point ? -1
                                 : p->point > q->point;
}

/* Each key once, the first of it. */
static void make_unique(event_list *list)
{
    if (list->count > 1)
    {
        qsort(list->event, list->count, sizeof *list->event, in_order);
    }
    size_t kept = 0;
    for (size_t i = 0; i < list->count; i++)
    {
        if (i == 0 || list->event[i].key != list->event[i - 1].key)
        {
            list->event[kept++] = list->event[i];
        }
    }
    list->count = kept;
}

/* ---- rays ---- */

typedef struct ray_walk
{
    double at[3];   /* voxels of the tree */
    double step[3]; /* along the ray's whole length */
    int32_t place[3];
    int32_t sign[3];
    double next[3]; /* the part of the ray at which the next voxel along an axis begins */
    double part[3]; /* of one voxel */
} ray_walk;

static void begin_ray(ray_walk *ray, const double from[3], const double to[3])
{
    for (int axis = 0; axis < 3; axis++)
    {
        ray->step[axis] = to[axis] - from[axis];
        ray->place[axis] = (int32_t)floor(from[axis]);
        ray->sign[axis] = ray->step[axis] > 0.0 ? 1 : -1;
        const double length = fabs(ray->step[axis]);
        const double border = ray->place[axis] + (ray->sign[axis] > 0 ? 1.0 : 0.0);
        ray->part[axis] = length > 0.0 ? 1.0 / length : INFINITY;
        ray->next[axis] = length > 0.0 ? fabs(border - from[axis]) / length : INFINITY;
    }
}

/* To the next voxel; 0 at the ray's end. */
static int next_voxel(ray_walk *ray)
{
    int axis = ray->next[0] <= ray->next[1] ? 0 : 1;
    axis = ray->next[axis] <= ray->next[2] ? axis : 2;
    if (!(ray->next[axis] < 1.0))
    {
        return 0;
    }
    ray->place[axis] += ray->sign[axis];
    ray->next[axis] += ray->part[axis];
    return 1;
}

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

static int is_of_map(const cm_octree *octree, const int32_t place[3])
{
    int is = 1;
    for (int axis = 0; axis < 3; axis++)
    {
        is &= place[axis] >= (int32_t)octree->first[axis] &&
              place[axis] < (int32_t)octree->beyond[axis];
    }
    return is;
}

/* Misses along a ray up to the voxel of its end, which is its own. */
static int add_misses(const cm_octree *octree, const double origin[3], const double end[3],
                      event_list *list)
{
    double from[3], to[3];
    memcpy(from, origin, sizeof from);
    memcpy(to, end, sizeof to);
    if (!cut(octree, from, to))
    {
        return 1;
    }
    ray_walk ray;
    begin_ray(&ray, from, to);
    int32_t last[3];
    for (int axis = 0; axis < 3; axis++)
    {
        last[axis] = (int32_t)floor(end[axis] < 1e9 && end[axis] > -1e9 ? end[axis] : -1.0);
    }
    do
    {
        if (memcmp(ray.place, last, sizeof last) == 0)
        {
            return 1;
        }
        const uint32_t place[3] = {(uint32_t)ray.place[0], (uint32_t)ray.place[1],
                                   (uint32_t)ray.place[2]};
        if (is_of_map(octree, ray.place) && !push(list, place, NO_POINT))
        {
            return 0;
        }
    } while (next_voxel(&ray));
    return 1;
}

/* ---- what each point says ---- */

static void to_voxels(const cm_octree *octree, const double world[3], double at[3])
{
    const double middle = ldexp(1.0, octree->tree_level - 1);
    for (int axis = 0; axis < 3; axis++)
    {
        at[axis] = (world[axis] - octree->options.centre[axis]) / octree->options.edge + middle;
    }
}

static int add_point(const cm_octree *octree, const double origin[3], const float *xyz,
                     uint64_t index, event_list *list)
{
    const double point[3] = {(double)xyz[0], (double)xyz[1], (double)xyz[2]};
    double away[3], square = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        away[axis] = point[axis] - origin[axis];
        square += away[axis] * away[axis];
    }
    const double range = sqrt(square), far = octree->options.far;
    if (!(range > 0.0 && range < 1e100) || range < octree->options.near)
    {
        return 1;
    }
    const int is_far = far > 0.0 && range > far;
    double end[3], from[3], to[3];
    for (int axis = 0; axis < 3; axis++)
    {
        end[axis] = is_far ? origin[axis] + away[axis] * (far / range) : point[axis];
    }
    to_voxels(octree, origin, from);
    to_voxels(octree, end, to);
    if (!is_far)
    {
        int32_t place[3];
        for (int axis = 0; axis < 3; axis++)
        {
            place[axis] = (int32_t)floor(to[axis] < 1e9 && to[axis] > -1e9 ? to[axis] : -1.0);
        }
        const uint32_t hit[3] = {(uint32_t)place[0], (uint32_t)place[1], (uint32_t)place[2]};
        if (is_of_map(octree, place) && !push(list, hit, index))
        {
            return 0;
        }
    }
    return add_misses(octree, from, to, list);
}

/* ---- into the tree ---- */

static int apply(cm_octree *octree, cm_region *region, const voxel_event *event, const uint8_t *rgb)
{
    const cm_count_rule *rule = &octree->rule;
    const unsigned block = (unsigned)(event->key >> 9 & 511u), cell = (unsigned)(event->key & 511u);
    const int is_hit = event->point != NO_POINT;
    const uint8_t even = region->value[block];
    if (!is_hit && region->form[block] == CM_BLOCK_EVEN && cm_after_misses(rule, even, 1) == even)
    {
        return 1; /* it stays even */
    }
    uint8_t *alpha = cm_block_open(region, block, rule, 0);
    if (alpha == NULL)
    {
        return 0;
    }
    const unsigned old = alpha[cell];
    const unsigned more = old + rule->hit < rule->high ? old + rule->hit : rule->high;
    alpha[cell] = is_hit ? (uint8_t)more : cm_after_misses(rule, old, 1);
    if (is_hit)
    {
        cm_region_mark(region, block, 1);
    }
    region->changed[block] = alpha[cell] != old ? octree->step : region->changed[block];
    if (is_hit && rgb != NULL && alpha[cell] > CM_UNKNOWN)
    {
        uint32_t *color = cm_block_colors(region, block);
        if (color == NULL)
        {
            return 0;
        }
        color[cell] =
            cm_color_mix(old > CM_UNKNOWN ? color[cell] : 0, cm_color_word(rgb + 3 * event->point),
                         cm_hits_of(rule, alpha[cell]));
    }
    else if (is_hit && old <= CM_UNKNOWN && region->color != NULL && region->color[block] != NULL)
    {
        region->color[block][cell] = 0; /* of its former life */
    }
    return 1;
}

static size_t end_of_region(const event_list *list, size_t first)
{
    const uint64_t key = list->event[first].key >> 3 * CM_REGION_LEVEL;
    size_t end = first;
    while (end < list->count && list->event[end].key >> 3 * CM_REGION_LEVEL == key)
    {
        end++;
    }
    return end;
}

/* All regions come into memory first, so that pages that fail leave the map as it was. */
static cm_status get_regions(cm_octree *octree, const event_list *list)
{
    cm_status status = CM_OK;
    for (size_t i = 0; status == CM_OK && i < list->count; i = end_of_region(list, i))
    {
        uint32_t place[3], node = 0;
        cm_divide(list->event[i].key >> 3 * CM_REGION_LEVEL << 3 * CM_REGION_LEVEL, place);
        cm_region *region = NULL;
        status = cm_node_reach(octree, place, CM_REGION_LEVEL, &node);
        status = status == CM_OK ? cm_node_region(octree, node, place, &region) : status;
    }
    return status;
}

static cm_status apply_all(cm_octree *octree, const event_list *list, const uint8_t *rgb)
{
    cm_status status = CM_OK;
    for (size_t i = 0; status == CM_OK && i < list->count;)
    {
        const uint64_t key = list->event[i].key >> 3 * CM_REGION_LEVEL;
        uint32_t place[3], node = 0;
        cm_divide(key << 3 * CM_REGION_LEVEL, place);
        cm_region *region = NULL;
        status = cm_node_reach(octree, place, CM_REGION_LEVEL, &node);
        status = status == CM_OK ? cm_node_region(octree, node, place, &region) : status;
        if (status != CM_OK)
        {
            return status;
        }
        octree->bytes -= cm_region_size(region);
        for (; i < list->count && list->event[i].key >> 3 * CM_REGION_LEVEL == key; i++)
        {
            status = apply(octree, region, &list->event[i], rgb) ? status : CM_ERROR_MEMORY;
        }
        for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
        {
            if (region->form[block] == CM_BLOCK_PLAIN && region->changed[block] == octree->step)
            {
                cm_block_settle(region, block);
            }
        }
        region->is_dirty = 1;
        octree->bytes += cm_region_size(region);
    }
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
    event_list list = {0};
    int good = 1;
    for (size_t i = 0; good && i < n; i++)
    {
        good = add_point(octree, origin, xyz + 3 * i, i, &list);
        if (good && list.count > (size_t)1 << 22 && list.count == list.room)
        {
            make_unique(&list); /* rays from one origin share most of their voxels */
        }
    }
    cm_status status = good ? CM_OK : CM_ERROR_MEMORY;
    if (status == CM_OK && list.count > 0)
    {
        make_unique(&list);
        cm_ray_index_forget(octree);
        octree->clock++;
        status = get_regions(octree, &list);
        octree->step += status == CM_OK;
        status =
            status == CM_OK ? apply_all(octree, &list, octree->options.color ? rgb : NULL) : status;
    }
    free(list.event);
    return status;
}
