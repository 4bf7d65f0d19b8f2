/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "ray_ends.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "interleave.h"

/* ---- where to look ---- */

/* Voxels reach over the picture's border no farther than breaks are heeded. What is steep is wider than a few pixels, or beside breaks,
 * and marked with the rules. */
void cm_ray_ends_mark(const cm_view_desk *desk, size_t row)
{
    const size_t runs = (desk->width + CM_BREAK_RUN - 1) / CM_BREAK_RUN;
    uint8_t *const may_end = desk->may_end + row * (desk->stride / CM_BREAK_RUN);
    if (row < CM_BREAK_RADIUS || row + CM_BREAK_RADIUS >= desk->height)
    {
        memset(may_end, 1, runs);
        return;
    }
    may_end[0] = 1;
    for (size_t run = runs; run-- > 0 && (run + 1) * CM_BREAK_RUN + CM_BREAK_RADIUS >= desk->width;)
    {
        may_end[run] = 1;
    }
}

static int has_hole(const cm_view_desk *desk, size_t row, size_t run)
{
    const float *const depth = desk->packed + row * desk->width;
    const size_t first = run * CM_BREAK_RUN;
    const size_t end = first + CM_BREAK_RUN < desk->width ? first + CM_BREAK_RUN : desk->width;
    int has = 0;
    for (size_t i = first; i < end; i++)
    {
        has |= isnan(depth[i]);
    }
    return has;
}

/* A voxel whose centre falls on a pixel that measured nothing is known by the rays beside that alone. */
static void mark_beside_holes(const cm_view_desk *desk)
{
    const size_t apart = desk->stride / CM_BREAK_RUN;
    const size_t runs = (desk->width + CM_BREAK_RUN - 1) / CM_BREAK_RUN;
    for (size_t row = 0; row < desk->height; row++)
    {
        for (size_t run = 0; run < runs; run++)
        {
            if (!has_hole(desk, row, run))
            {
                continue;
            }
            const size_t first = run > 0 ? run - 1 : 0, end = run + 1 < runs ? run + 2 : runs;
            const size_t last_row = row + 1 < desk->height ? row + 1 : row;
            for (size_t beside = row > 0 ? row - 1 : 0; beside <= last_row; beside++)
            {
                memset(desk->may_end + beside * apart + first, 1, end - first);
            }
        }
    }
}

/* ---- a picture ---- */

typedef struct end_work
{
    const cm_view_desk *desk;
    const cm_octree *octree;
    cm_eye eye;
    int64_t eye_place[3]; /* the voxel that the camera is in, from the tree's lower corner */
    cm_ray_end *list;
    atomic_size_t count;
} end_work;

static int key_of(const end_work *work, const cm_ended_run *run, unsigned k, uint64_t *key)
{
    uint32_t place[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const int64_t at = work->eye_place[axis] + run->cell[axis][k];
        if (at < (int64_t)work->octree->first[axis] || at >= (int64_t)work->octree->beyond[axis])
        {
            return 0;
        }
        place[axis] = (uint32_t)at;
    }
    *key = cm_interleave(place);
    return 1;
}

static int is_same_cell(const cm_ended_run *run, unsigned a, unsigned b)
{
    return run->cell[0][a] == run->cell[0][b] && run->cell[1][a] == run->cell[1][b] &&
           run->cell[2][a] == run->cell[2][b];
}

static void take_ends(end_work *work, const cm_ended_run *run, uint32_t lost, size_t first)
{
    cm_ray_end found[CM_BREAK_RUN];
    size_t count = 0;
    unsigned last = CM_BREAK_RUN;
    for (; lost != 0; lost &= lost - 1)
    {
        const unsigned k = (unsigned)__builtin_ctz(lost);
        const int is_new = last == CM_BREAK_RUN || !is_same_cell(run, last, k);
        last = k;
        if (is_new && key_of(work, run, k, &found[count].key))
        {
            found[count++].pixel = first + k;
        }
    }
    if (count > 0)
    {
        const size_t at = atomic_fetch_add(&work->count, count);
        memcpy(work->list + at, found, count * sizeof *found);
    }
}

/* So many rows are asked for before they are looked at. */
#define ROWS_AHEAD 4

static void find_in_rows(size_t first_row, size_t end_row, void *user)
{
    end_work *work = user;
    const cm_view_desk *desk = work->desk;
    const size_t runs = desk->stride / CM_BREAK_RUN;
    cm_ended_run run;
    for (size_t row = first_row; row < end_row; row++)
    {
        for (size_t column = 0; column < desk->width; column += CM_BREAK_RUN)
        {
            if (!desk->may_end[row * runs + column / CM_BREAK_RUN])
            {
                continue;
            }
            /* what is marked often goes down, along a border or a silhouette */
            const cm_pixel_rule *below =
                &desk->rule[(row + ROWS_AHEAD < desk->height ? row + ROWS_AHEAD : row) *
                                desk->stride +
                            column];
            __builtin_prefetch(below);
            __builtin_prefetch(below + CM_BREAK_RUN / 2);
            uint32_t lost = work->octree->set->lost_ends(&desk->table, &work->eye, (uint32_t)column,
                                                         (uint32_t)row, &run);
            lost &=
                column + CM_BREAK_RUN <= desk->width ? ~0u : (1u << (desk->width - column)) - 1u;
            take_ends(work, &run, lost, row * desk->stride + column);
        }
    }
}

/* The camera's place in edges, as whole ones and the rest. 0: so far away that nothing of the map is seen in single precision. */
static int describe_eye(end_work *work, const cm_view *view)
{
    const cm_octree_options *options = &work->octree->options;
    const double middle = ldexp(1.0, work->octree->tree_level - 1);
    for (int axis = 0; axis < 3; axis++)
    {
        const double at =
            CM_PLACE_OF(view->pose.position[axis], options->centre[axis], options->edge, middle);
        if (!(fabs(at) < 1e9))
        {
            return 0;
        }
        work->eye_place[axis] = (int64_t)floor(at);
        work->eye.aside[axis] = (float)(at - floor(at));
    }
    const double focal[3] = {(double)work->desk->table.focal[0], (double)work->desk->table.focal[1],
                             1.0};
    for (int i = 0; i < 9; i++)
    {
        const double of_axis = view->pose.rotation.row[i / 3][i % 3];
        work->eye.ray[i / 3][i % 3] = (float)(of_axis / (focal[i / 3] * options->edge));
        work->eye.step[i / 3][i % 3] = (float)(of_axis * focal[i / 3] * options->edge);
    }
    return 1;
}

static int compare_ends(const void *one, const void *other)
{
    const cm_ray_end *a = one, *b = other;
    return a->key != b->key ? (a->key < b->key ? -1 : 1)
                            : (a->pixel > b->pixel) - (a->pixel < b->pixel);
}

/* One digit of the keys, of eight bits, keeping the order of equal ones. 0: all have the same, and nothing was moved. */
static int sort_by_digit(const cm_ray_end *from, size_t count, unsigned shift, cm_ray_end *to)
{
    size_t place[256] = {0};
    for (size_t i = 0; i < count; i++)
    {
        place[from[i].key >> shift & 255u]++;
    }
    if (place[from[0].key >> shift & 255u] == count)
    {
        return 0;
    }
    size_t sum = 0;
    for (unsigned digit = 0; digit < 256; digit++)
    {
        const size_t own = place[digit];
        place[digit] = sum;
        sum += own;
    }
    for (size_t i = 0; i < count; i++)
    {
        to[place[from[i].key >> shift & 255u]++] = from[i];
    }
    return 1;
}

/* By keys alone, digit by digit, where there is room for as many more. Returns where they are. */
static cm_ray_end *sort_keys(cm_ray_end *list, size_t count)
{
    cm_ray_end *from = list, *to = list + count;
    for (unsigned shift = 0; shift < 64; shift += 8)
    {
        if (sort_by_digit(from, count, shift, to))
        {
            cm_ray_end *const sorted = to;
            to = from;
            from = sorted;
        }
    }
    return from;
}

cm_ray_ends cm_ray_ends_sort(cm_ray_end *list, size_t found, size_t room)
{
    if (found == 0)
    {
        return (cm_ray_ends){NULL, NULL};
    }
    cm_ray_end *sorted = list;
    if (found <= room / 2)
    {
        sorted = sort_keys(list, found);
    }
    else
    {
        qsort(list, found, sizeof *list, compare_ends);
    }
    size_t count = 0;
    for (size_t i = 0; i < found; i++)
    {
        if (count == 0 || sorted[i].key != sorted[count - 1].key)
        {
            sorted[count++] = sorted[i];
        }
        else if (sorted[i].pixel < sorted[count - 1].pixel)
        {
            sorted[count - 1].pixel = sorted[i].pixel;
        }
    }
    return (cm_ray_ends){sorted, sorted + count};
}

static int has_room(cm_view_desk *desk)
{
    size_t runs = 0;
    for (size_t i = 0; i < desk->height * (desk->stride / CM_BREAK_RUN); i++)
    {
        runs += desk->may_end[i];
    }
    const size_t wanted = runs * CM_BREAK_RUN;
    if (wanted > desk->end_room)
    {
        free(desk->end);
        desk->end = cm_array_of(wanted, sizeof *desk->end);
        desk->end_room = desk->end == NULL ? 0 : wanted;
    }
    return wanted <= desk->end_room;
}

cm_status cm_ray_ends_find(cm_view_desk *desk, const cm_octree *octree, const cm_view *view,
                           cm_pool *pool, cm_ray_ends *ends)
{
    end_work work = {.desk = desk, .octree = octree};
    ends->first = ends->end = NULL;
    if (!describe_eye(&work, view))
    {
        return CM_OK;
    }
    if (desk->has_holes)
    {
        mark_beside_holes(desk);
    }
    if (!has_room(desk))
    {
        return CM_ERROR_MEMORY;
    }
    work.list = desk->end;
    cm_pool_run(pool, desk->height, 16, find_in_rows, &work);
    *ends = cm_ray_ends_sort(work.list, atomic_load(&work.count), desk->end_room);
    return CM_OK;
}

/* ---- cubes ---- */

cm_ray_ends cm_ray_ends_take_block(cm_ray_ends *ends, unsigned block)
{
    const cm_ray_end *end = ends->first;
    while (end != ends->end && (end->key >> 9 & 511u) == block)
    {
        end++;
    }
    const cm_ray_ends taken = {ends->first, end};
    ends->first = end;
    return taken;
}

void cm_ray_ends_hit(cm_ray_ends ends, uint64_t hits[8], int32_t pixel[8][64])
{
    for (const cm_ray_end *end = ends.first; end != ends.end; end++)
    {
        const unsigned group = (unsigned)(end->key >> 6 & 7u), cell = (unsigned)(end->key & 63u);
        const uint64_t bit = (uint64_t)1 << cell;
        if ((hits[group] & bit) == 0)
        {
            hits[group] |= bit;
            pixel[group][cell] = (int32_t)end->pixel;
        }
    }
}

static const cm_ray_end *first_from(cm_ray_ends ends, uint64_t key)
{
    size_t low = 0, high = ends.first == NULL ? 0 : (size_t)(ends.end - ends.first);
    while (low < high)
    {
        const size_t middle = low + (high - low) / 2;
        low = ends.first[middle].key < key ? middle + 1 : low;
        high = ends.first[middle].key < key ? high : middle;
    }
    return low == 0 ? ends.first : ends.first + low;
}

cm_ray_ends cm_ray_ends_in(cm_ray_ends ends, const uint32_t place[3], int level)
{
    if (ends.first == ends.end)
    {
        return ends;
    }
    const uint64_t key = cm_interleave(place);
    const cm_ray_ends rest = {first_from(ends, key), ends.end};
    return (cm_ray_ends){rest.first, first_from(rest, key + ((uint64_t)1 << 3 * level))};
}
