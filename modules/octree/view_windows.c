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
        windows +=
            level_cells(desk->width, levels) * level_cells(desk->height, levels) + CM_OCTREE_SLACK;
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
        const size_t cells = (size_t)at->width * at->height + CM_OCTREE_SLACK;
        at->bounds = next;
        desk->table.first_window[level] = (uint32_t)(next - desk->windows);
        desk->table.window_row[level] = at->width;
        next += cells;
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

/* One cell more to the right and below, where nothing is: windows there are of what there is. */
static void close_cells(cm_view_desk *desk, int which, size_t width, size_t height)
{
    float *least = desk->least[which], *most = desk->most[which];
    for (size_t row = 0; row < height; row++)
    {
        for (size_t i = width; i < width + CM_OCTREE_SLACK; i++)
        {
            least[row * desk->stride + i] = INFINITY;
            most[row * desk->stride + i] = -INFINITY;
        }
    }
    for (size_t i = 0; i < width + CM_OCTREE_SLACK; i++)
    {
        least[height * desk->stride + i] = INFINITY;
        most[height * desk->stride + i] = -INFINITY;
    }
}

/* Rows of a level's windows or cells, for threads. */
typedef struct window_work
{
    cm_view_desk *desk;
    const cm_octree_set *set;
    int level;
} window_work;

/* As many rows at a time: fewer are not worth a thread. */
#define ROWS_AT_A_TIME 64

/* Whole vectors are stored, over the first windows of the next row where they do not end with their own: then one thread goes down. */
static size_t window_rows(const cm_window_level *level)
{
    return level->width % CM_OCTREE_SLACK == 0 ? ROWS_AT_A_TIME : level->height;
}

static void make_windows(size_t first, size_t end, void *user)
{
    const window_work *work = user;
    const cm_view_desk *desk = work->desk;
    const cm_window_level *at = &desk->table.level[work->level];
    const int which = work->level & 1;
    for (size_t row = first; row < end; row++)
    {
        const float *least = desk->least[which] + row * desk->stride;
        const float *most = desk->most[which] + row * desk->stride;
        const float *const leasts[2] = {least, least + desk->stride};
        const float *const mosts[2] = {most, most + desk->stride};
        work->set->windows(at->width, leasts, mosts, at->bounds + row * at->width);
    }
}

static void make_cells(size_t first, size_t end, void *user)
{
    const window_work *work = user;
    const cm_view_desk *desk = work->desk;
    const cm_window_level *at = &desk->table.level[work->level];
    const int from = (work->level - 1) & 1, to = work->level & 1;
    for (size_t row = first; row < end; row++)
    {
        const float *least = desk->least[from] + 2 * row * desk->stride;
        const float *most = desk->most[from] + 2 * row * desk->stride;
        const float *const leasts[2] = {least, least + desk->stride};
        const float *const mosts[2] = {most, most + desk->stride};
        work->set->halve(at->width, leasts, mosts, desk->least[to] + row * desk->stride,
                         desk->most[to] + row * desk->stride);
    }
}

void cm_view_desk_windows(cm_view_desk *desk, const cm_octree_set *set, cm_pool *pool)
{
    window_work work = {.desk = desk, .set = set};
    for (int level = 1; level < desk->table.levels; level++)
    {
        const cm_window_level *at = &desk->table.level[level];
        work.level = level;
        if (level > 1)
        {
            make_cells(0, at->height, &work);
        }
        close_cells(desk, level & 1, at->width, at->height);
        /* all levels above the first are less than its third: not worth waiting for threads */
        cm_pool_run(level == 1 ? pool : NULL, at->height, window_rows(at), make_windows, &work);
    }
    const cm_window_level *last = &desk->table.level[desk->table.levels - 1];
    desk->greatest = last->bounds[0].most;
}
