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
    size_t first_row;
    size_t end_row;
    cm_break_slots *slots;
} break_work;

/* The slot of a pixel, which is made if it has none. */
static cm_break_slot *slot_of(const break_work *work, size_t pixel)
{
    cm_break_slots *slots = work->slots;
    uint32_t *index = &work->desk->slot_of[pixel];
    if (*index != 0)
    {
        return &slots->slot[*index - 1];
    }
    if (slots->count == slots->room)
    {
        const size_t room = slots->room == 0 ? 4096 : 2 * slots->room;
        cm_break_slot *more = realloc(slots->slot, room * sizeof *more);
        if (more == NULL)
        {
            return NULL;
        }
        slots->slot = more;
        slots->room = room;
    }
    *index = (uint32_t)++slots->count;
    cm_break_slot *slot = &slots->slot[slots->count - 1];
    *slot = (cm_break_slot){.pixel = (uint32_t)pixel,
                            .own_front = work->desk->front[pixel],
                            .near_front = INFINITY,
                            .near_back = -INFINITY};
    return slot;
}

static float smaller(float a, float b)
{
    return a < b ? a : b;
}

/* A pixel tells another, so many pixels apart, what it sees. Half a pixel less may lie between a voxel's centre and its ray. */
static int tell(const break_work *work, size_t from, size_t to, uint32_t apart)
{
    const cm_view_desk *desk = work->desk;
    const float front = desk->front[from], back = desk->back[from];
    const float between = (float)apart - 0.5f;
    const int is_in_reach = between * front <= desk->heed;
    if (!is_in_reach || !(front < desk->front[to]))
    {
        return 1;
    }
    cm_break_slot *slot = slot_of(work, to);
    if (slot == NULL)
    {
        return 0;
    }
    if (back < desk->front[to])
    {
        /* what is closely behind may be the side of the same body, as far as voxels reach its silhouette */
        const float until = smaller(desk->heed / between, back + desk->hides);
        const float hides = until > back ? until : back;
        slot->near_front = smaller(slot->near_front, front);
        slot->near_back = hides > slot->near_back ? hides : slot->near_back;
    }
    else
    {
        slot->own_front = smaller(slot->own_front, front);
    }
    return 1;
}

/* How many pixels around one may heed it. */
static size_t radius_of(const cm_view_desk *desk, size_t pixel)
{
    const float radius = desk->heed / desk->front[pixel] + 0.5f;
    return radius >= 0.0f && radius < CM_BREAK_RADIUS ? (size_t)radius : CM_BREAK_RADIUS;
}

static int tell_around(const break_work *work, size_t row, size_t column)
{
    const cm_view_desk *desk = work->desk;
    const size_t stride = desk->stride, from = row * stride + column;
    const size_t radius = radius_of(desk, from);
    const size_t low_row = row > radius ? row - radius : 0;
    const size_t high_row = row + radius < work->end_row ? row + radius + 1 : work->end_row;
    const size_t low = column > radius ? column - radius : 0;
    const size_t high = column + radius < desk->width ? column + radius + 1 : desk->width;
    int made = 1;
    for (size_t r = low_row > work->first_row ? low_row : work->first_row; r < high_row; r++)
    {
        for (size_t c = low; c < high; c++)
        {
            const size_t down = r > row ? r - row : row - r;
            const size_t along = c > column ? c - column : column - c;
            const size_t apart = down > along ? down : along;
            if (apart > 0)
            {
                made &= tell(work, from, r * stride + c, (uint32_t)apart);
            }
        }
    }
    return made;
}

static float least_heeded(const cm_break_slot *slot)
{
    return smaller(slot->own_front, slot->near_front);
}

int cm_breaks_find(cm_view_desk *desk, size_t first_row, size_t end_row, cm_break_slots *slots)
{
    const break_work work = {desk, first_row, end_row, slots};
    const size_t low = first_row > CM_BREAK_RADIUS ? first_row - CM_BREAK_RADIUS : 0;
    const size_t high =
        end_row + CM_BREAK_RADIUS < desk->height ? end_row + CM_BREAK_RADIUS : desk->height;
    int made = 1;
    for (size_t row = low; row < high; row++)
    {
        const uint8_t *kind = desk->kind + row * desk->stride;
        for (size_t i = 0; i < desk->width; i += 8)
        {
            uint64_t eight;
            memcpy(&eight, kind + i, sizeof eight);
            for (size_t k = i; eight != 0 && k < i + 8 && k < desk->width; k++)
            {
                made &= kind[k] == 0 || tell_around(&work, row, k);
            }
        }
    }
    for (size_t i = 0; i < slots->count; i++)
    {
        desk->slot_of[slots->slot[i].pixel] = 0;
    }
    return made;
}

void cm_breaks_heed(cm_view_desk *desk, const cm_break_slots *slots)
{
    for (size_t i = 0; i < slots->count; i++)
    {
        desk->front[slots->slot[i].pixel] = least_heeded(&slots->slot[i]);
    }
}

void cm_breaks_gaps(cm_view_desk *desk, const cm_break_slots *slots)
{
    for (size_t i = 0; i < slots->count; i++)
    {
        const cm_break_slot *slot = &slots->slot[i];
        cm_pixel_rule *rule = &desk->rule[slot->pixel];
        if (slot->near_front < INFINITY && slot->near_back < slot->own_front &&
            rule->reach_front >> 16 != 0 && !isnan(rule->depth))
        {
            rule->reach_front |= CM_RULE_HAS_GAP;
            desk->gap[slot->pixel] = (cm_pixel_gap){slot->near_back, slot->own_front};
        }
    }
}
