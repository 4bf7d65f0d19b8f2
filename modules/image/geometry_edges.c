/* SPDX-License-Identifier: MIT */
#include "geometry_edges.h"

static int is_group_inside(const cm_surface *from, const cm_group *group, double slack)
{
    const double column = group->column + 0.5;
    const double row = group->row + 0.5;
    return column + (double)group->low[0] >= -slack &&
           column + (double)group->high[0] <= from->width + slack &&
           row + (double)group->low[1] >= -slack &&
           row + (double)group->high[1] <= from->height + slack;
}

static void copy_pixel(const cm_group *from, unsigned i, cm_group *to, int derivatives)
{
    const unsigned k = to->count++;
    to->x[k] = from->x[i];
    to->y[k] = from->y[i];
    to->own_pixel[k] = from->pixel[i];
    for (int axis = 0; derivatives && axis < 2; axis++)
    {
        to->by_column[axis][k] = from->by_column[axis][i];
        to->by_row[axis][k] = from->by_row[axis][i];
    }
}

/* Pixels that the target's plane does not have leave a group of all. */
void cm_group_drop_beyond(const cm_surface *to, int derivatives, uint32_t block_column,
                          uint32_t block_row, cm_group *group)
{
    const uint32_t columns = to->width - block_column * CM_BLOCK_EDGE;
    const uint32_t rows = to->height - block_row * CM_BLOCK_EDGE;
    if (columns < CM_BLOCK_EDGE || rows < CM_BLOCK_EDGE)
    {
        group->count = 0;
        for (unsigned i = 0; i < CM_BLOCK_PIXELS; i++)
        {
            if (i % CM_BLOCK_EDGE < columns && i / CM_BLOCK_EDGE < rows)
            {
                copy_pixel(group, i, group, derivatives);
            }
        }
        group->pixel = group->own_pixel;
    }
}

/* Pixels that have gone round come from the other end. Returns how many groups there are, 0 if places are beyond the
 * source's plane. */
static unsigned bring_back(const cm_surface *from, int derivatives, double slack, cm_group *groups)
{
    cm_group all = groups[0];
    const double row = all.row + 0.5;
    unsigned count[3] = {0};
    uint8_t side[CM_BLOCK_PIXELS];
    for (unsigned i = 0; i < all.count; i++)
    {
        const double x = all.column + 0.5 + (double)all.x[i];
        const double y = row + (double)all.y[i];
        if (y < -slack || y > from->height + slack)
        {
            return 0;
        }
        side[i] = x < -slack ? 0 : x > from->width + slack ? 2 : 1;
        count[side[i]]++;
    }
    if (count[0] + count[2] == 0)
    {
        return 1;
    }
    if (from->period == 0.0)
    {
        return 0;
    }
    if (all.pixel == groups[0].own_pixel)
    {
        all.pixel = all.own_pixel; /* the first group is written over */
    }
    unsigned used = 0;
    for (int s = 0; s < 3; s++)
    {
        if (count[s] == 0)
        {
            continue;
        }
        cm_group *group = &groups[used++];
        group->plane = all.plane;
        group->pixel = group->own_pixel;
        group->column = all.column + (1 - s) * (int32_t)from->width;
        group->row = all.row;
        group->is_bounded = 0;
        group->is_tight = 0;
        group->count = 0;
        for (unsigned i = 0; i < all.count; i++)
        {
            if (side[i] == s)
            {
                copy_pixel(&all, i, group, derivatives);
            }
        }
    }
    return used;
}

unsigned cm_group_settle(const cm_surface *from, int derivatives, double slack, cm_group *groups)
{
    return is_group_inside(from, groups, slack) ? 1 : bring_back(from, derivatives, slack, groups);
}
