/* SPDX-License-Identifier: MIT */
#include <cubemap/compensate.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "modules/memory/checked_size.h"
#include "compensate_warp.h"

/* ---- schemes ---- */

static const char *const names[] = {"CCM-B", "CCM-U", "CCM-2", "CCM-1", "NCM", "NCM-nearest"};

static int is_scheme(cm_compensation scheme)
{
    return (unsigned)scheme < sizeof names / sizeof *names;
}

const char *cm_compensation_name(cm_compensation scheme)
{
    return is_scheme(scheme) ? names[scheme] : NULL;
}

static int is_channel_count(cm_compensation scheme, uint32_t channels)
{
    return channels >= (scheme == CM_CCM_2 ? 4u : 2u) && channels <= CM_COMPENSATE_CHANNELS_MAX;
}

static size_t flow_count(cm_compensation scheme, uint32_t channels)
{
    switch (scheme)
    {
    case CM_CCM_B:
        return 2 * (size_t)(channels - 1);
    case CM_CCM_2:
        return 2;
    case CM_CCM_1:
        return 1;
    default:
        return channels - 1;
    }
}

/* Whether a channel is nearer to its own frame's reference than to the next one's. */
static int is_near(uint32_t channel, uint32_t channels)
{
    return 2 * channel <= channels;
}

static cm_flow_pair pair_between_frames(uint32_t channel, int is_forward)
{
    return (cm_flow_pair){is_forward ? -1 : 0, channel, is_forward ? 0 : -1, channel};
}

static cm_flow_pair pair_at(cm_compensation scheme, uint32_t channels, size_t index)
{
    const uint32_t channel = (uint32_t)index + 1;
    switch (scheme)
    {
    case CM_CCM_B:
        return pair_between_frames((uint32_t)(index / 2) + 1, index % 2 == 0);
    case CM_CCM_U:
        return pair_between_frames(channel, !is_near(channel, channels));
    case CM_CCM_2:
    case CM_CCM_1:
        return pair_between_frames(index == 0 ? 1 : channels - 1, 0);
    default:
        break;
    }
    if (scheme == CM_NCM || is_near(channel, channels))
    {
        return (cm_flow_pair){0, channel, 0, channel - 1};
    }
    return channel + 1 < channels ? (cm_flow_pair){-1, channel, -1, channel + 1}
                                  : (cm_flow_pair){-1, channel, 0, 0};
}

cm_status cm_compensation_flows(cm_compensation scheme, uint32_t channels, size_t room,
                                cm_flow_pair *pair, size_t *count)
{
    if (!is_scheme(scheme) || count == NULL || (pair == NULL && room > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!is_channel_count(scheme, channels))
    {
        return CM_ERROR_RANGE;
    }
    *count = flow_count(scheme, channels);
    for (size_t i = 0; i < *count && i < room; i++)
    {
        pair[i] = pair_at(scheme, channels, i);
    }
    return room < *count && pair != NULL ? CM_ERROR_SPACE : CM_OK;
}

/* ---- one channel ---- */

/* What the work on a channel needs beside its results. */
typedef struct channel_desk
{
    cm_warp_desk warp;
    float *carried[2];
    float *coverage[2];
    float *drawn;
    uint8_t *doubtful;
} channel_desk;

typedef struct compensation
{
    const cm_compensation_input *input;
    cm_compensation scheme;
    cm_picture_size size;
    float *corrected;
    channel_desk *desk;
} compensation;

static const float *picture_of(const compensation *c, int frame, uint32_t channel)
{
    return (frame == 0 ? c->input->now : c->input->before) + channel * cm_pixels_of(c->size);
}

static const float *flow_of(const compensation *c, size_t index)
{
    return c->input->flow + 2 * index * cm_pixels_of(c->size);
}

/* A part of the way from one frame's channel to the other's. */
static double part_of(const compensation *c, uint32_t steps)
{
    return (double)steps / (double)c->input->channels;
}

/* The picture by its flow, into corrected. */
static void move_channel(const compensation *c, const channel_desk *desk, const float *picture,
                         const float *flow, double part, float *corrected)
{
    cm_carry_flow(c->size, flow, NULL, part, &desk->warp, desk->carried[0], desk->coverage[0]);
    cm_draw_moved(c->size, picture, desk->carried[0], part, corrected);
}

/* Content that the way there and the way back do not bring back is hidden in the other picture, and its flow a guess:
 * Sundaram, Brox and Keutzer 2010, eq. 5. */
static void find_hidden(cm_picture_size size, const float *flow, const float *back, uint8_t *hidden)
{
    const size_t pixels = cm_pixels_of(size);
    for (size_t i = 0; i < pixels; i++)
    {
        const double d[2] = {(double)flow[2 * i], (double)flow[2 * i + 1]};
        const double column = (double)(i % size.width) + d[0];
        const double row = (double)(i / size.width) + d[1];
        double e[2];
        cm_flow_at(size, back, column, row, e);
        const double off = (d[0] + e[0]) * (d[0] + e[0]) + (d[1] + e[1]) * (d[1] + e[1]);
        const double squares = d[0] * d[0] + d[1] * d[1] + e[0] * e[0] + e[1] * e[1];
        const int is_inside =
            column >= 0.0 && row >= 0.0 && column < size.width && row < size.height;
        hidden[i] = is_inside && off > 0.01 * squares + 0.5;
    }
}

/* The mean of two, by how much came to each: the sign (+) of eqs. 2 and 5. What is not finite counts for nothing. */
static float merge(float a, float b, float weight_a, float weight_b)
{
    if (!isfinite(a) || !isfinite(b))
    {
        return isfinite(a) ? a : b;
    }
    const float weight = weight_a + weight_b;
    return weight > 0.0f ? a + (b - a) * (weight_b / weight) : a + (b - a) * 0.5f;
}

/* Eq. 2. */
static void correct_both_ways(const compensation *c, const channel_desk *desk, uint32_t channel,
                              float *corrected)
{
    const float *forward = flow_of(c, 2 * (size_t)channel - 2);
    const float *backward = flow_of(c, 2 * (size_t)channel - 1);
    const double ahead = part_of(c, c->input->channels - channel), back = part_of(c, channel);
    find_hidden(c->size, backward, forward, desk->doubtful);
    cm_carry_flow(c->size, backward, desk->doubtful, back, &desk->warp, desk->carried[0],
                  desk->coverage[0]);
    cm_draw_moved(c->size, picture_of(c, 0, channel), desk->carried[0], back, desk->drawn);
    find_hidden(c->size, forward, backward, desk->doubtful);
    cm_carry_flow(c->size, forward, desk->doubtful, ahead, &desk->warp, desk->carried[1],
                  desk->coverage[1]);
    cm_draw_moved(c->size, picture_of(c, -1, channel), desk->carried[1], ahead, corrected);
    const size_t pixels = cm_pixels_of(c->size);
    for (size_t i = 0; i < pixels; i++)
    {
        corrected[i] =
            merge(desk->drawn[i], corrected[i], desk->coverage[0][i], desk->coverage[1][i]);
    }
}

/* Eq. 3. */
static void correct_shorter_way(const compensation *c, const channel_desk *desk, uint32_t channel,
                                float *corrected)
{
    const uint32_t n = c->input->channels;
    const float *flow = flow_of(c, channel - 1);
    if (is_near(channel, n))
    {
        move_channel(c, desk, picture_of(c, 0, channel), flow, part_of(c, channel), corrected);
    }
    else
    {
        move_channel(c, desk, picture_of(c, -1, channel), flow, part_of(c, n - channel), corrected);
    }
}

/* Eq. 4, and eq. 5 where there is a second flow: the flow of this channel, of those of channel 1 and n - 1. */
static const float *flow_between(const compensation *c, const channel_desk *desk, uint32_t channel)
{
    const uint32_t last = c->input->channels - 1;
    const int has_two = c->scheme == CM_CCM_2;
    if (channel == 1 || (has_two && channel == last))
    {
        return flow_of(c, channel == 1 ? 0 : 1);
    }
    float *flow = desk->carried[1];
    cm_carry_flow(c->size, flow_of(c, 0), NULL, -part_of(c, channel - 1), &desk->warp, flow,
                  desk->coverage[1]);
    if (has_two)
    {
        const float *other = desk->carried[0];
        cm_carry_flow(c->size, flow_of(c, 1), NULL, part_of(c, last - channel), &desk->warp,
                      desk->carried[0], desk->coverage[0]);
        const size_t pixels = cm_pixels_of(c->size);
        for (size_t i = 0; i < 2 * pixels; i++)
        {
            flow[i] = merge(flow[i], other[i], desk->coverage[1][i / 2], desk->coverage[0][i / 2]);
        }
    }
    return flow;
}

/* Eqs. 6 and 7: steps one behind the other, added on the way so that the picture is drawn once. The flow of channel k is
 * number k - 1, whichever way it goes. */
static void correct_by_neighbours(const compensation *c, const channel_desk *desk, uint32_t channel,
                                  float *corrected)
{
    const uint32_t n = c->input->channels;
    const int is_back = c->scheme == CM_NCM || is_near(channel, n);
    const uint32_t steps = is_back ? channel : n - channel;
    float *way = desk->carried[1];
    const size_t pixels = cm_pixels_of(c->size);
    memcpy(way, flow_of(c, channel - 1), 2 * pixels * sizeof *way);
    for (uint32_t step = 1; step < steps; step++)
    {
        const float *flow = flow_of(c, is_back ? channel - 1 - step : channel - 1 + step);
        for (size_t i = 0; i < pixels; i++)
        {
            double d[2];
            cm_flow_at(c->size, flow, (double)(i % c->size.width) + (double)way[2 * i],
                       (double)(i / c->size.width) + (double)way[2 * i + 1], d);
            way[2 * i] += (float)d[0];
            way[2 * i + 1] += (float)d[1];
        }
    }
    move_channel(c, desk, picture_of(c, is_back ? 0 : -1, channel), way, 1.0, corrected);
}

static void correct_channel(const compensation *c, const channel_desk *desk, uint32_t channel)
{
    float *corrected = c->corrected + channel * cm_pixels_of(c->size);
    switch (c->scheme)
    {
    case CM_CCM_B:
        correct_both_ways(c, desk, channel, corrected);
        break;
    case CM_CCM_U:
        correct_shorter_way(c, desk, channel, corrected);
        break;
    case CM_CCM_2:
    case CM_CCM_1:
        move_channel(c, desk, picture_of(c, 0, channel), flow_between(c, desk, channel),
                     part_of(c, channel), corrected);
        break;
    default:
        correct_by_neighbours(c, desk, channel, corrected);
    }
}

/* ---- all of them ---- */

static void correct_some(size_t begin, size_t end, void *user)
{
    const compensation *c = user;
    for (size_t i = begin; i < end; i++)
    {
        correct_channel(c, &c->desk[begin], (uint32_t)i + 1);
    }
}

enum
{
    FLOATS_OF_A_DESK = 3 + 2 * 2 + 2 + 1
};

/* Pieces of work begin at different channels, and each takes the desk of its first. */
static float *make_desks(channel_desk *desk, size_t count, size_t pixels)
{
    const size_t each = FLOATS_OF_A_DESK * sizeof(float) + sizeof(uint32_t) + 1;
    float *memory = cm_array_of(pixels, cm_size_product(each, count));
    if (memory == NULL)
    {
        return NULL;
    }
    float *at = memory;
    for (size_t i = 0; i < count; i++)
    {
        desk[i].warp.sum = at;
        desk[i].carried[0] = at + 3 * pixels;
        desk[i].carried[1] = at + 5 * pixels;
        desk[i].coverage[0] = at + 7 * pixels;
        desk[i].coverage[1] = at + 8 * pixels;
        desk[i].drawn = at + 9 * pixels;
        at += FLOATS_OF_A_DESK * pixels;
    }
    uint32_t *front = (uint32_t *)(void *)at;
    uint8_t *doubtful = (uint8_t *)(front + count * pixels);
    for (size_t i = 0; i < count; i++)
    {
        desk[i].warp.front = front + i * pixels;
        desk[i].doubtful = doubtful + i * pixels;
    }
    return memory;
}

static cm_status check_input(const cm_compensation_input *input, cm_compensation scheme)
{
    if (!is_channel_count(scheme, input->channels) ||
        !cm_is_picture_size(input->width, input->height))
    {
        return CM_ERROR_RANGE;
    }
    return CM_OK;
}

cm_status cm_compensate(const cm_compensation_input *input, cm_compensation scheme, cm_pool *pool,
                        float *corrected)
{
    if (input == NULL || input->size != sizeof *input || !is_scheme(scheme) || corrected == NULL ||
        input->now == NULL || input->flow == NULL || (input->before == NULL && scheme != CM_NCM))
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status = check_input(input, scheme);
    if (status != CM_OK)
    {
        return status;
    }
    channel_desk desk[CM_COMPENSATE_CHANNELS_MAX];
    const compensation all = {input, scheme, {input->width, input->height}, corrected, desk};
    const size_t pixels = cm_pixels_of(all.size), moved = input->channels - 1;
    void *memory = make_desks(desk, cm_pool_threads(pool) == 1 ? 1 : moved, pixels);
    if (memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    memcpy(corrected, input->now, pixels * sizeof *corrected);
    cm_pool_run(pool, moved, 1, correct_some, (void *)(uintptr_t)&all);
    free(memory);
    return CM_OK;
}

/* ---- without flows ---- */

/* Whether a value is another than the frame before's; what is not finite both times is the same. */
static int has_changed(const cm_compensation_input *input, size_t place, double threshold)
{
    const double now = (double)input->now[place], before = (double)input->before[place];
    if (!isfinite(now) || !isfinite(before))
    {
        return isfinite(now) || isfinite(before);
    }
    return fabs(now - before) > threshold;
}

cm_status cm_compensate_pixelwise(const cm_compensation_input *input, double threshold,
                                  float *corrected, size_t *changed)
{
    if (input == NULL || input->size != sizeof *input || corrected == NULL || input->now == NULL ||
        input->before == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (check_input(input, CM_CCM_1) != CM_OK || !(threshold >= 0.0))
    {
        return CM_ERROR_RANGE;
    }
    const size_t pixels = cm_pixels_of((cm_picture_size){input->width, input->height});
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++)
    {
        int is_after = 0;
        const int was_still = !has_changed(input, i, threshold);
        for (uint32_t w = 0; w < input->channels; w++)
        {
            const size_t place = w * pixels + i;
            is_after = is_after || (was_still && has_changed(input, place, threshold));
            corrected[place] = is_after ? input->before[place] : input->now[place];
        }
        count += (size_t)is_after;
    }
    if (changed != NULL)
    {
        *changed = count;
    }
    return CM_OK;
}
