/* SPDX-License-Identifier: MIT */
#include "level_rim.h"

#include <string.h>

/* Farther away a bend says nothing any more. */
#define BENT 3

cm_rim_nodes cm_rim_nodes_at(int32_t away, int32_t room)
{
    if (away <= BENT && 2 * away <= room)
    {
        return (cm_rim_nodes){3, {0, away, 2 * away}, {3.0f, -3.0f, 1.0f}};
    }
    if (away <= room)
    {
        return (cm_rim_nodes){2, {0, away, 0}, {2.0f, -1.0f, 0.0f}};
    }
    return (cm_rim_nodes){1, {0, 0, 0}, {1.0f, 0.0f, 0.0f}};
}

int cm_rim_goes_on(const cm_values *values)
{
    return values->alpha == 0 && values->working == values->channels;
}

static void add_pixel(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                      float weight, float *sum)
{
    unsigned char pixel[(CM_CHANNELS_MAX + 1) * sizeof(float)];
    cm_level_load(level, plane, column, row, 1, pixel);
    for (uint32_t c = 0; c < level->channels; c++)
    {
        float value = pixel[c];
        if (!level->is_bytes)
        {
            memcpy(&value, pixel + c * sizeof value, sizeof value);
        }
        sum[c] += weight * value;
    }
}

/* ---- edges ---- */

cm_rim_nodes cm_rim_nodes_along(int32_t at, uint32_t extent, int goes_on, int32_t *last,
                                int32_t *inwards)
{
    const int32_t end = (int32_t)extent - 1;
    const int32_t away = at < 0 ? -at : at > end ? at - end : 0;
    *last = at < 0 ? 0 : at > end ? end : at;
    *inwards = at < 0 ? 1 : -1;
    return cm_rim_nodes_at(away, away == 0 || !goes_on ? -1 : end);
}

void cm_level_continue_edge(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                            unsigned char *to)
{
    float sum[CM_CHANNELS_MAX + 1] = {0.0f};
    int32_t last[2], inwards[2];
    const int goes_on = cm_rim_goes_on(level->values);
    const cm_rim_nodes x = cm_rim_nodes_along(column, level->width, goes_on, &last[0], &inwards[0]);
    const cm_rim_nodes y = cm_rim_nodes_along(row, level->height, goes_on, &last[1], &inwards[1]);
    for (int32_t j = 0; j < y.count; j++)
    {
        for (int32_t i = 0; i < x.count; i++)
        {
            add_pixel(level, plane, last[0] + inwards[0] * x.from_last[i],
                      last[1] + inwards[1] * y.from_last[j], x.weight[i] * y.weight[j], sum);
        }
    }
    cm_level_put(level, sum, to);
}

/* ---- rims ---- */

#define WAYS 8

static const int32_t ways[WAYS][2] = {{1, 0}, {0, 1},  {-1, 0},  {0, -1},
                                      {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

/* How far it is to the map, at most reach; more if it is not there. */
static int32_t steps_to_map(const cm_level *level, const cm_gaps *gaps, unsigned plane,
                            int32_t column, int32_t row, const int32_t way[2], int32_t reach)
{
    int32_t away = 1;
    while (away <= reach &&
           !cm_gaps_have(level, gaps, plane, column + away * way[0], row + away * way[1]))
    {
        away++;
    }
    return away;
}

static void add_line(const cm_level *level, const cm_gaps *gaps, unsigned plane, int32_t column,
                     int32_t row, const int32_t way[2], int32_t away, float *sum)
{
    const int32_t last[2] = {column + away * way[0], row + away * way[1]};
    int32_t room = 0;
    for (int32_t k = 2; k > 0 && room == 0 && cm_rim_goes_on(level->values); k--)
    {
        const int32_t inner = k * away;
        room =
            cm_gaps_have(level, gaps, plane, last[0] + inner * way[0], last[1] + inner * way[1]) &&
                    (k == 1 || cm_gaps_have(level, gaps, plane, last[0] + away * way[0],
                                            last[1] + away * way[1]))
                ? inner
                : 0;
    }
    const cm_rim_nodes nodes = cm_rim_nodes_at(away, room);
    for (int32_t i = 0; i < nodes.count; i++)
    {
        add_pixel(level, plane, last[0] + nodes.from_last[i] * way[0],
                  last[1] + nodes.from_last[i] * way[1], nodes.weight[i], sum);
    }
}

int cm_level_continue_rim(const cm_level *level, const cm_gaps *gaps, unsigned plane,
                          int32_t column, int32_t row, int32_t reach, unsigned char *to)
{
    float sum[CM_CHANNELS_MAX + 1] = {0.0f};
    int32_t steps[WAYS];
    int32_t least = reach + 1;
    float count = 0.0f;
    for (int k = 0; k < WAYS; k++)
    {
        steps[k] = steps_to_map(level, gaps, plane, column, row, ways[k], reach);
        least = steps[k] < least ? steps[k] : least;
    }
    for (int k = 0; k < WAYS && least <= reach; k++)
    {
        if (steps[k] == least)
        {
            add_line(level, gaps, plane, column, row, ways[k], least, sum);
            count += 1.0f;
        }
    }
    for (uint32_t c = 0; c < level->channels && count > 0.0f; c++)
    {
        sum[c] /= count;
    }
    if (count > 0.0f)
    {
        cm_level_put(level, sum, to);
    }
    return count > 0.0f;
}
