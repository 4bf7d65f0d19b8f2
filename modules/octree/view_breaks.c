/* SPDX-License-Identifier: MIT
 *
 * Where what is seen breaks off, at silhouettes and creases: pixels there also heed the surfaces that pixels nearby see, since
 * voxels may reach over to them.
 */
#include "view_table.h"

#include <math.h>
#include <string.h>

typedef struct break_work
{
    const cm_view_desk *desk;
    const cm_octree_set *set;
    const cm_view_band *band;
    size_t first_row;
    size_t end_row;
} break_work;

/* The runs of some pixels of a row are ready to be told something. */
static void take_runs(const break_work *work, size_t row, size_t low, size_t high)
{
    const cm_view_band *band = work->band;
    for (size_t first = low / CM_BREAK_RUN * CM_BREAK_RUN; first < high; first += CM_BREAK_RUN)
    {
        const size_t pixel = cm_view_row(work->desk, row) + first;
        uint8_t *is_taken = &band->is_taken[pixel / CM_BREAK_RUN];
        if (*is_taken)
        {
            continue;
        }
        *is_taken = 1;
        for (size_t i = pixel; i < pixel + CM_BREAK_RUN; i++)
        {
            band->own_front[i] = band->near_front[i] = INFINITY;
            band->near_back[i] = -INFINITY;
        }
    }
}

/* How many pixels around one may heed it. */
static size_t radius_of(const break_work *work, size_t pixel)
{
    const float radius = work->desk->heed / work->band->front[pixel] + 0.5f;
    return radius >= 0.0f && radius < CM_BREAK_RADIUS ? (size_t)radius : CM_BREAK_RADIUS;
}

/* A pixel tells those around it what it sees. */
static void tell_around(const break_work *work, size_t row, size_t column)
{
    const cm_view_desk *desk = work->desk;
    const cm_view_band *band = work->band;
    const size_t from = cm_view_row(desk, row) + column;
    const size_t radius = radius_of(work, from);
    const size_t above = row > radius ? row - radius : 0;
    const size_t first_row = above > work->first_row ? above : work->first_row;
    const size_t end_row = row + radius < work->end_row ? row + radius + 1 : work->end_row;
    const size_t low = column > radius ? column - radius : 0;
    const size_t high = column + radius < desk->width ? column + radius + 1 : desk->width;
    cm_break_teller teller = {.front = band->front[from],
                              .back = band->back[from],
                              .heed = desk->heed,
                              .hides = desk->hides,
                              .radius = (float)radius,
                              .first = CM_BREAK_RADIUS - (column - low)};
    for (size_t r = first_row; r < end_row; r++)
    {
        const size_t to = cm_view_row(desk, r) + low;
        teller.down = (float)(r > row ? r - row : row - r);
        take_runs(work, r, low, high);
        work->set->tell(high - low, &teller, band->front + to, band->own_front + to,
                        band->near_front + to, band->near_back + to);
    }
}

void cm_breaks_tell(const cm_view_desk *desk, const cm_octree_set *set, const cm_view_band *band,
                    size_t row, size_t first_row, size_t end_row)
{
    const break_work work = {desk, set, band, first_row, end_row};
    const uint8_t *kind = band->kind + cm_view_row(desk, row);
    for (size_t i = 0; i < desk->width; i += CM_BREAK_RUN)
    {
        uint64_t half[2];
        memcpy(half, kind + i, sizeof half);
        for (size_t k = i; (half[0] | half[1]) != 0 && k < i + CM_BREAK_RUN; k++)
        {
            if (kind[k] != 0)
            {
                tell_around(&work, row, k);
            }
        }
    }
}

static float smaller(float a, float b)
{
    return a < b ? a : b;
}

void cm_breaks_heed(const cm_view_desk *desk, const cm_view_band *band, size_t row)
{
    for (size_t column = 0; column < desk->width; column += CM_BREAK_RUN)
    {
        const size_t first = cm_view_row(desk, row) + column;
        if (!band->is_taken[first / CM_BREAK_RUN])
        {
            continue;
        }
        float *restrict front = band->front + first;
        float *restrict own = band->own_front + first;
        const float *restrict near_front = band->near_front + first;
        for (size_t k = 0; k < CM_BREAK_RUN; k++)
        {
            own[k] = smaller(own[k], front[k]);
            front[k] = smaller(near_front[k], own[k]);
        }
    }
}

/* Of a run that begins at a pixel of the band, and is that of the picture. */
static void make_gaps(const cm_view_desk *desk, const cm_view_band *band, size_t first,
                      size_t in_picture)
{
    for (size_t k = 0; k < CM_BREAK_RUN; k++)
    {
        if (!(band->near_front[first + k] < INFINITY))
        {
            continue;
        }
        cm_pixel_rule *rule = &desk->rule[in_picture + k];
        if (rule->reach_front >> 16 != 0 && !isnan(rule->depth))
        {
            rule->reach_front |= CM_RULE_HAS_GAP;
            desk->gap[in_picture + k] =
                (cm_pixel_gap){band->near_back[first + k], band->own_front[first + k]};
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

void cm_breaks_gaps(const cm_view_desk *desk, const cm_view_band *band, size_t row)
{
    for (size_t column = 0; column < desk->width; column += CM_BREAK_RUN)
    {
        const size_t first = cm_view_row(desk, row) + column;
        uint8_t *is_taken = &band->is_taken[first / CM_BREAK_RUN];
        if (*is_taken && has_near(band->near_front + first))
        {
            make_gaps(desk, band, first, row * desk->stride + column);
        }
        *is_taken = 0;
    }
}
