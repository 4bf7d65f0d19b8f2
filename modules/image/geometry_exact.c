/* SPDX-License-Identifier: MIT */
#include "geometry_exact.h"
#include "geometry_edges.h"
#include "lattice.h"

#include <math.h>
#include <string.h>

static void place_block(const cm_surface *to, unsigned plane, uint32_t block_column,
                        uint32_t block_row, cm_exact_places *at)
{
    const double left = (double)block_column * CM_BLOCK_EDGE + 0.5;
    const double top = (double)block_row * CM_BLOCK_EDGE + 0.5;
    const unsigned columns = (unsigned)fmin(to->width + 0.5 - left, CM_BLOCK_EDGE);
    const unsigned rows = (unsigned)fmin(to->height + 0.5 - top, CM_BLOCK_EDGE);
    unsigned n = 0;
    at->plane = plane;
    for (unsigned r = 0; r < rows; r++)
    {
        for (unsigned k = 0; k < columns; k++, n++)
        {
            at->column[n] = left + k;
            at->row[n] = top + r;
            at->pixel[n] = (uint8_t)(r * CM_BLOCK_EDGE + k);
        }
    }
    at->count = n;
}

/* Do places lie on both sides of where columns begin again? */
static int is_wrapped(const cm_exact_places *at, double period)
{
    double low = INFINITY;
    double high = -INFINITY;
    for (unsigned i = 0; i < at->count && period > 0.0; i++)
    {
        low = at->x[i] < low ? at->x[i] : low;
        high = at->x[i] > high ? at->x[i] : high;
    }
    return period > 0.0 && high - low > 0.5 * period;
}

/* The one group of places that are all on one plane. */
static void group_all(const cm_exact_places *at, cm_group *group)
{
    cm_group_begin(group, at->found[0], at->x[0], at->y[0]);
    const double column = group->column + 0.5;
    const double row = group->row + 0.5;
    for (unsigned i = 0; i < at->count; i++)
    {
        group->x[i] = (float)(at->x[i] - column);
        group->y[i] = (float)(at->y[i] - row);
    }
    memcpy(group->own_pixel, at->pixel, at->count);
    group->count = at->count;
}

static unsigned group_places(const cm_plan *plan, const cm_exact_places *at, cm_group *groups,
                             uint8_t *group_of)
{
    uint8_t used_by[CM_PLANES_MAX + 1];
    const double half = is_wrapped(at, plan->from->period) ? 0.5 * plan->from->period : INFINITY;
    unsigned used = 0;
    if (half == INFINITY && at->found[0] != CM_NO_FACE &&
        memcmp(at->found, at->found + 1, at->count - 1) == 0)
    {
        memset(group_of, 0, at->count);
        group_all(at, groups);
        return 1;
    }
    memset(used_by, CM_NO_FACE, sizeof used_by);
    for (unsigned i = 0; i < at->count; i++)
    {
        group_of[i] = CM_NO_FACE;
        if (at->found[i] == CM_NO_FACE)
        {
            continue;
        }
        uint8_t *index = &used_by[at->found[i] + (at->x[i] > half ? 1 : 0)];
        if (*index == CM_NO_FACE)
        {
            *index = (uint8_t)used;
            cm_group_begin(&groups[used++], at->found[i], at->x[i], at->y[i]);
        }
        cm_group *group = &groups[*index];
        group_of[i] = *index;
        group->x[group->count] = (float)(at->x[i] - (group->column + 0.5));
        group->y[group->count] = (float)(at->y[i] - (group->row + 0.5));
        group->own_pixel[group->count++] = at->pixel[i];
    }
    return used;
}

unsigned cm_exact_block(const cm_plan *plan, int derivatives, unsigned plane, uint32_t block_column,
                        uint32_t block_row, cm_group *groups)
{
    cm_exact_places at;
    uint8_t group_of[CM_BLOCK_PIXELS];
    place_block(plan->to, plane, block_column, block_row, &at);
    cm_lattice_find(plan, plane, at.count, at.column, at.row, at.found, at.x, at.y);
    const unsigned used = group_places(plan, &at, groups, group_of);
    if (derivatives)
    {
        cm_exact_slopes(plan, &at, group_of, groups);
    }
    return used;
}
