/* SPDX-License-Identifier: MIT
 *
 * Where what is seen breaks off, at silhouettes and creases: pixels there also heed the surfaces that pixels nearby see, since
 * voxels may reach over to them.
 */
#include "view_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct break_work
{
    cm_view_desk *desk;
    const cm_octree_set *set;
    size_t first_row;
    size_t end_row;
    cm_break_runs *runs;
} break_work;

/* The runs of some pixels of a row are ready to be told something. 0: no memory. */
static int take_runs(const break_work *work, size_t row, size_t low, size_t high)
{
    cm_view_desk *desk = work->desk;
    cm_break_runs *runs = work->runs;
    for (size_t first = low / CM_BREAK_RUN * CM_BREAK_RUN; first < high; first += CM_BREAK_RUN)
    {
        const size_t pixel = row * desk->stride + first;
        uint8_t *is_taken = &desk->is_taken[pixel / CM_BREAK_RUN];
        if (*is_taken)
        {
            continue;
        }
        if (runs->count == runs->room)
        {
            const size_t room = runs->room == 0 ? 1024 : 2 * runs->room;
            uint32_t *more = realloc(runs->first, room * sizeof *more);
            if (more == NULL)
            {
                return 0;
            }
            runs->first = more;
            runs->room = room;
        }
        *is_taken = 1;
        runs->first[runs->count++] = (uint32_t)pixel;
        for (size_t i = pixel; i < pixel + CM_BREAK_RUN; i++)
        {
            desk->own_front[i] = desk->near_front[i] = INFINITY;
            desk->near_back[i] = -INFINITY;
        }
    }
    return 1;
}

/* How many pixels around one may heed it. */
static size_t radius_of(const cm_view_desk *desk, size_t pixel)
{
    const float radius = desk->heed / desk->front[pixel] + 0.5f;
    return radius >= 0.0f && radius < CM_BREAK_RADIUS ? (size_t)radius : CM_BREAK_RADIUS;
}

/* A pixel tells those around it what it sees. */
static int tell_around(const break_work *work, size_t row, size_t column)
{
    const cm_view_desk *desk = work->desk;
    const size_t stride = desk->stride, from = row * stride + column;
    const size_t radius = radius_of(desk, from);
    const size_t above = row > radius ? row - radius : 0;
    const size_t first_row = above > work->first_row ? above : work->first_row;
    const size_t end_row = row + radius < work->end_row ? row + radius + 1 : work->end_row;
    const size_t low = column > radius ? column - radius : 0;
    const size_t high = column + radius < desk->width ? column + radius + 1 : desk->width;
    cm_break_teller teller = {.front = desk->front[from],
                              .back = desk->back[from],
                              .heed = desk->heed,
                              .hides = desk->hides,
                              .radius = (float)radius,
                              .first = CM_BREAK_RADIUS - (column - low)};
    int made = 1;
    for (size_t r = first_row; made && r < end_row; r++)
    {
        const size_t to = r * stride + low;
        teller.down = (float)(r > row ? r - row : row - r);
        made = take_runs(work, r, low, high);
        if (made)
        {
            work->set->tell(high - low, &teller, desk->front + to, desk->own_front + to,
                            desk->near_front + to, desk->near_back + to);
        }
    }
    return made;
}

int cm_breaks_find(cm_view_desk *desk, const cm_octree_set *set, size_t first_row, size_t end_row,
                   cm_break_runs *runs)
{
    const break_work work = {desk, set, first_row, end_row, runs};
    const size_t low = first_row > CM_BREAK_RADIUS ? first_row - CM_BREAK_RADIUS : 0;
    const size_t high =
        end_row + CM_BREAK_RADIUS < desk->height ? end_row + CM_BREAK_RADIUS : desk->height;
    int made = 1;
    for (size_t row = low; row < high; row++)
    {
        const uint8_t *kind = desk->kind + row * desk->stride;
        for (size_t i = 0; i < desk->width; i += CM_BREAK_RUN)
        {
            uint64_t half[2];
            memcpy(half, kind + i, sizeof half);
            for (size_t k = i; (half[0] | half[1]) != 0 && k < i + CM_BREAK_RUN; k++)
            {
                made &= kind[k] == 0 || tell_around(&work, row, k);
            }
        }
    }
    for (size_t i = 0; i < runs->count; i++)
    {
        desk->is_taken[runs->first[i] / CM_BREAK_RUN] = 0;
    }
    return made;
}

static float smaller(float a, float b)
{
    return a < b ? a : b;
}

void cm_breaks_heed(cm_view_desk *desk, const cm_break_runs *runs)
{
    for (size_t i = 0; i < runs->count; i++)
    {
        float *restrict front = desk->front + runs->first[i];
        float *restrict own = desk->own_front + runs->first[i];
        const float *restrict near_front = desk->near_front + runs->first[i];
        for (size_t k = 0; k < CM_BREAK_RUN; k++)
        {
            own[k] = smaller(own[k], front[k]);
            front[k] = smaller(near_front[k], own[k]);
        }
    }
}

static int has_near(const float *near_front)
{
    int has = 0;
    for (size_t k = 0; k < CM_BREAK_RUN; k++)
    {
        has |= near_front[k] < INFINITY;
    }
    return has;
}

void cm_breaks_gaps(cm_view_desk *desk, const cm_break_runs *runs)
{
    for (size_t i = 0; i < runs->count; i++)
    {
        const size_t end = runs->first[i] + CM_BREAK_RUN;
        if (!has_near(desk->near_front + runs->first[i]))
        {
            continue;
        }
        for (size_t pixel = runs->first[i]; pixel < end; pixel++)
        {
            if (!(desk->near_front[pixel] < INFINITY))
            {
                continue;
            }
            cm_pixel_rule *rule = &desk->rule[pixel];
            if (rule->reach_front >> 16 != 0 && !isnan(rule->depth))
            {
                rule->reach_front |= CM_RULE_HAS_GAP;
                desk->gap[pixel] = (cm_pixel_gap){desk->near_back[pixel], desk->own_front[pixel]};
            }
        }
    }
}
