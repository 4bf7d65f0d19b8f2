/* SPDX-License-Identifier: MIT
 *
 * Bounds of what the pixels of a view say, in windows of all levels.
 */
#include "modules/memory/checked_size.h"
#include "view_table.h"

#include <math.h>

#include "huge_pages.h"

/* ---- memory ---- */

static size_t level_cells(uint32_t pixels, int level)
{
    return (size_t)(((uint64_t)pixels + (1u << level) - 1) >> level);
}

/* Windows from row to row: vectors are stored whole. */
static size_t row_windows(uint32_t pixels, int level)
{
    return (level_cells(pixels, level) + CM_OCTREE_SLACK - 1) / CM_OCTREE_SLACK * CM_OCTREE_SLACK;
}

static int has_more_levels(const cm_view_desk *desk, int level)
{
    return level_cells(desk->width, level) > 2 || level_cells(desk->height, level) > 2;
}

int cm_view_windows_take(cm_view_desk *desk)
{
    size_t windows = 0;
    int levels = 1;
    do
    {
        windows += row_windows(desk->width, levels) * level_cells(desk->height, levels);
        levels++;
    } while (has_more_levels(desk, levels - 1));
    desk->windows = cm_huge_allocate(cm_size_product(windows, sizeof *desk->windows));
    cm_cube_bounds *next = desk->windows;
    desk->table.levels = levels;
    desk->table.window = desk->windows;
    for (int level = 1; desk->windows != NULL && level < levels; level++)
    {
        cm_window_level *at = &desk->table.level[level];
        at->width = (uint32_t)level_cells(desk->width, level);
        at->height = (uint32_t)level_cells(desk->height, level);
        const size_t row = row_windows(desk->width, level);
        at->bounds = next;
        desk->table.first_window[level] = (uint32_t)(next - desk->windows);
        desk->table.window_row[level] = (uint32_t)row;
        next += row * at->height;
    }
    return desk->windows != NULL;
}

int cm_view_cells_take(cm_view_desk *desk)
{
    desk->stride = cm_view_stride(desk->width);
    float **const images[] = {&desk->least[0], &desk->least[1], &desk->most[0], &desk->most[1]};
    const size_t count = sizeof images / sizeof *images, cells = cm_view_cells(desk);
    const size_t numbers = cm_size_product(count, cells);
    float *const memory = cm_huge_allocate(cm_size_product(numbers, sizeof *memory));
    desk->memory = memory;
    for (size_t i = 0; memory != NULL && i < count; i++)
    {
        *images[i] = memory + i * cells + CM_OCTREE_SLACK;
    }
    return memory != NULL && cm_view_windows_take(desk);
}

/* ---- windows ---- */

/* Behind the cells of a row nothing is, and in the row behind the last: windows there are of what there is. */
static void close_row(const cm_view_desk *desk, int level, size_t row)
{
    const cm_window_level *at = &desk->table.level[level];
    float *least = desk->least[level & 1] + row * desk->stride;
    float *most = desk->most[level & 1] + row * desk->stride;
    for (size_t i = row < at->height ? at->width : 0; i < at->width + CM_OCTREE_SLACK; i++)
    {
        least[i] = INFINITY;
        most[i] = -INFINITY;
    }
}

static void close_rows(const cm_view_desk *desk, int level)
{
    for (size_t row = 0; row <= desk->table.level[level].height; row++)
    {
        close_row(desk, level, row);
    }
}

/* Windows of a row of cells and the one below. */
static void make_row(const cm_view_desk *desk, const cm_octree_set *set, int level, size_t row)
{
    const cm_window_level *at = &desk->table.level[level];
    const float *least = desk->least[level & 1] + row * desk->stride;
    const float *most = desk->most[level & 1] + row * desk->stride;
    const float *const leasts[2] = {least, least + desk->stride};
    const float *const mosts[2] = {most, most + desk->stride};
    set->windows(at->width, leasts, mosts, at->bounds + row * desk->table.window_row[level]);
}

/* Cells of a level from those of the level below it. */
static void make_cells(const cm_view_desk *desk, const cm_octree_set *set, int level)
{
    const cm_window_level *at = &desk->table.level[level];
    const int from = (level - 1) & 1, to = level & 1;
    for (size_t row = 0; row < at->height; row++)
    {
        const float *least = desk->least[from] + 2 * row * desk->stride;
        const float *most = desk->most[from] + 2 * row * desk->stride;
        const float *const leasts[2] = {least, least + desk->stride};
        const float *const mosts[2] = {most, most + desk->stride};
        set->halve(at->width, leasts, mosts, desk->least[to] + row * desk->stride,
                   desk->most[to] + row * desk->stride);
    }
}

void cm_view_windows_close(const cm_view_desk *desk, size_t row)
{
    close_row(desk, 1, row);
}

void cm_view_windows_row(const cm_view_desk *desk, const cm_octree_set *set, size_t row)
{
    make_row(desk, set, 1, row);
}

/* All of these levels are less than a third of the first: not worth waiting for threads. */
void cm_view_windows_above(cm_view_desk *desk, const cm_octree_set *set)
{
    for (int level = 2; level < desk->table.levels; level++)
    {
        make_cells(desk, set, level);
        close_rows(desk, level);
        for (size_t row = 0; row < desk->table.level[level].height; row++)
        {
            make_row(desk, set, level, row);
        }
    }
    const cm_window_level *last = &desk->table.level[desk->table.levels - 1];
    desk->greatest = last->bounds[0].most;
}

/* Rows of the first level, for threads. */
typedef struct window_work
{
    const cm_view_desk *desk;
    const cm_octree_set *set;
} window_work;

/* As many rows at a time: fewer are not worth a thread. */
#define ROWS_AT_A_TIME 64

static void make_rows(size_t first, size_t end, void *user)
{
    const window_work *work = user;
    for (size_t row = first; row < end; row++)
    {
        make_row(work->desk, work->set, 1, row);
    }
}

void cm_view_desk_windows(cm_view_desk *desk, const cm_octree_set *set, cm_pool *pool)
{
    window_work work = {desk, set};
    close_rows(desk, 1);
    cm_pool_run(pool, desk->table.level[1].height, ROWS_AT_A_TIME, make_rows, &work);
    cm_view_windows_above(desk, set);
}
