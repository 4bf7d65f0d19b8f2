/* SPDX-License-Identifier: MIT
 *
 * Bounds of what the pixels of a view say, in windows of all levels.
 */
#include <math.h>

#include "view_table.h"

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

static void make_windows(cm_view_desk *desk, const cm_octree_set *set, int level)
{
    cm_window_level *at = &desk->table.level[level];
    const int which = level & 1;
    for (size_t row = 0; row < at->height; row++)
    {
        const float *least = desk->least[which] + row * desk->stride;
        const float *most = desk->most[which] + row * desk->stride;
        const float *const leasts[2] = {least, least + desk->stride};
        const float *const mosts[2] = {most, most + desk->stride};
        set->windows(at->width, leasts, mosts, at->least + row * at->width,
                     at->most + row * at->width);
    }
}

static void make_cells(cm_view_desk *desk, const cm_octree_set *set, int level)
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

void cm_view_desk_windows(cm_view_desk *desk, const cm_octree_set *set)
{
    close_cells(desk, 0, desk->width, desk->height);
    make_windows(desk, set, 0);
    for (int level = 1; level < desk->table.levels; level++)
    {
        const cm_window_level *at = &desk->table.level[level];
        make_cells(desk, set, level);
        close_cells(desk, level & 1, at->width, at->height);
        make_windows(desk, set, level);
    }
    const cm_window_level *last = &desk->table.level[desk->table.levels - 1];
    desk->greatest = last->most[0];
}
