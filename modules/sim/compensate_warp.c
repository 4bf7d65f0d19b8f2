/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "compensate_warp.h"

#include <cubemap/compensate.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NO_PIXEL UINT32_MAX
/* Pixels; flows that are farther apart than that belong to different things. */
#define APART 1.0
/* What comes by a doubtful flow weighs so much: it counts where nothing else comes. */
#define DOUBT (1.0 / 1024.0)
#define PART_MOST 1000.0

int cm_is_picture_size(uint32_t width, uint32_t height)
{
    return width > 0 && height > 0 && (uint64_t)width * height < (uint64_t)1 << 31;
}

size_t cm_pixels_of(cm_picture_size size)
{
    return (size_t)size.width * size.height;
}

/* ---- carrying ---- */

/* Where a pixel's content comes to. */
typedef struct landing
{
    double column;
    double row;
} landing;

/* 0 if it leaves the picture or nothing is known of it. */
static int find_landing(cm_picture_size size, const float *flow, double part, uint32_t column,
                        uint32_t row, landing *at)
{
    const size_t pixel = (size_t)row * size.width + column;
    const double dx = (double)flow[2 * pixel], dy = (double)flow[2 * pixel + 1];
    if (!isfinite(dx) || !isfinite(dy))
    {
        return 0;
    }
    at->column = column + part * dx;
    at->row = row + part * dy;
    return at->column > -1.0 && at->column < (double)size.width && at->row > -1.0 &&
           at->row < (double)size.height;
}

static double speed_of(const float *flow, size_t pixel)
{
    const double dx = (double)flow[2 * pixel], dy = (double)flow[2 * pixel + 1];
    return dx * dx + dy * dy;
}

static int is_doubtful(const uint8_t *doubtful, size_t pixel)
{
    return doubtful != NULL && doubtful[pixel];
}

static int is_before(const float *flow, const uint8_t *doubtful, size_t pixel, size_t other)
{
    const int doubt = is_doubtful(doubtful, pixel), others = is_doubtful(doubtful, other);
    return doubt != others ? others : speed_of(flow, pixel) > speed_of(flow, other);
}

/* The pixel before a number above -1: its floor, without a call. */
static int64_t floor_of(double at)
{
    return (int64_t)(at + 1.0) - 1;
}

static void compete(cm_picture_size size, const float *flow, const uint8_t *doubtful, size_t pixel,
                    const landing *at, uint32_t *front)
{
    const int64_t column = floor_of(at->column + 0.5), row = floor_of(at->row + 0.5);
    if (column < 0 || row < 0 || column >= size.width || row >= size.height)
    {
        return;
    }
    const size_t to = (size_t)row * size.width + (size_t)column;
    if (front[to] == NO_PIXEL || is_before(flow, doubtful, pixel, front[to]))
    {
        front[to] = (uint32_t)pixel;
    }
}

/* The fastest of those that come nearest to each pixel, of the doubtful ones if there are no others. */
static void find_fronts(cm_picture_size size, const float *flow, const uint8_t *doubtful,
                        double part, uint32_t *front)
{
    const size_t pixels = cm_pixels_of(size);
    for (size_t i = 0; i < pixels; i++)
    {
        front[i] = NO_PIXEL;
    }
    for (uint32_t row = 0; row < size.height; row++)
    {
        for (uint32_t column = 0; column < size.width; column++)
        {
            landing at;
            if (find_landing(size, flow, part, column, row, &at))
            {
                compete(size, flow, doubtful, (size_t)row * size.width + column, &at, front);
            }
        }
    }
}

static void add_share(const float *flow, size_t pixel, size_t to, double weight,
                      const cm_warp_desk *desk)
{
    if (weight <= 0.0)
    {
        return;
    }
    if (desk->front[to] == NO_PIXEL)
    {
        desk->front[to] = (uint32_t)pixel;
    }
    const size_t front = desk->front[to];
    const double dx = (double)flow[2 * pixel] - (double)flow[2 * front];
    const double dy = (double)flow[2 * pixel + 1] - (double)flow[2 * front + 1];
    if (dx * dx + dy * dy <= APART * APART)
    {
        float *sum = desk->sum + 3 * to;
        sum[0] += (float)weight;
        sum[1] += (float)(weight * dx);
        sum[2] += (float)(weight * dy);
    }
}

/* To the four pixels around, by their distance. */
static void share_out(cm_picture_size size, const float *flow, size_t pixel, const landing *at,
                      double share, const cm_warp_desk *desk)
{
    const int64_t column = floor_of(at->column), row = floor_of(at->row);
    const double right = at->column - (double)column, down = at->row - (double)row;
    for (int k = 0; k < 4; k++)
    {
        const int64_t x = column + (k & 1), y = row + (k >> 1);
        if (x >= 0 && y >= 0 && x < size.width && y < size.height)
        {
            const double weight = (k & 1 ? right : 1.0 - right) * (k >> 1 ? down : 1.0 - down);
            add_share(flow, pixel, (size_t)y * size.width + (size_t)x, share * weight, desk);
        }
    }
}

static float known(float value)
{
    return isfinite(value) ? value : 0.0f;
}

static void divide(cm_picture_size size, const float *flow, const cm_warp_desk *desk,
                   float *carried, float *coverage)
{
    const size_t pixels = cm_pixels_of(size);
    for (size_t i = 0; i < pixels; i++)
    {
        const float *sum = desk->sum + 3 * i;
        const int came = sum[0] > 0.0f;
        const size_t front = came ? desk->front[i] : i;
        for (size_t k = 0; k < 2; k++)
        {
            carried[2 * i + k] = known(flow[2 * front + k]) + (came ? sum[1 + k] / sum[0] : 0.0f);
        }
        coverage[i] = sum[0] < 1.0f ? sum[0] : 1.0f;
    }
}

void cm_carry_flow(cm_picture_size size, const float *flow, const uint8_t *doubtful, double part,
                   const cm_warp_desk *desk, float *carried, float *coverage)
{
    const size_t pixels = cm_pixels_of(size);
    find_fronts(size, flow, doubtful, part, desk->front);
    memset(desk->sum, 0, 3 * pixels * sizeof *desk->sum);
    for (uint32_t row = 0; row < size.height; row++)
    {
        for (uint32_t column = 0; column < size.width; column++)
        {
            const size_t i = (size_t)row * size.width + column;
            landing at;
            if (find_landing(size, flow, part, column, row, &at))
            {
                share_out(size, flow, i, &at, is_doubtful(doubtful, i) ? DOUBT : 1.0, desk);
            }
        }
    }
    divide(size, flow, desk, carried, coverage);
}

/* ---- looking between pixels ---- */

/* A place along a side: the pixel before it, and how far it is behind that. */
typedef struct place
{
    int64_t pixel;
    double beyond;
} place;

static place place_of(double at, uint32_t count)
{
    const double most = (double)(count - 1);
    const double inside = at > 0.0 ? at < most ? at : most : 0.0;
    const int64_t pixel = (int64_t)inside;
    return (place){pixel, inside - (double)pixel};
}

static size_t within(int64_t pixel, uint32_t count)
{
    return pixel < 0 ? 0 : pixel >= (int64_t)count ? count - 1 : (size_t)pixel;
}

void cm_flow_at(cm_picture_size size, const float *flow, double column, double row, double d[2])
{
    const place x = place_of(column, size.width), y = place_of(row, size.height);
    d[0] = d[1] = 0.0;
    for (int k = 0; k < 4; k++)
    {
        const double weight =
            (k & 1 ? x.beyond : 1.0 - x.beyond) * (k >> 1 ? y.beyond : 1.0 - y.beyond);
        const size_t pixel = within(y.pixel + (k >> 1), size.height) * size.width +
                             within(x.pixel + (k & 1), size.width);
        if (weight > 0.0) /* 0 times what is not known would not be known */
        {
            d[0] += weight * (double)flow[2 * pixel];
            d[1] += weight * (double)flow[2 * pixel + 1];
        }
    }
}

/* The cubic of Keys 1981, a = -1/2, through the four values around a place. */
static void weigh(double t, double weight[4])
{
    weight[0] = t * (-0.5 + t * (1.0 - 0.5 * t));
    weight[1] = 1.0 + t * t * (-2.5 + 1.5 * t);
    weight[2] = t * (0.5 + t * (2.0 - 1.5 * t));
    weight[3] = t * t * (-0.5 + 0.5 * t);
}

/* The sum over 4 x 4 pixels, of which the rows and columns are given. */
static double weighted_sum(const float *const line[4], const size_t column[4],
                           const double across[4], const double down[4])
{
    double sum = 0.0;
    for (int j = 0; j < 4; j++)
    {
        double part = 0.0;
        for (int i = 0; i < 4; i++)
        {
            part += across[i] * (double)line[j][column[i]];
        }
        sum += down[j] * part;
    }
    return sum;
}

static float value_at(cm_picture_size size, const float *picture, double column, double row)
{
    const place x = place_of(column, size.width), y = place_of(row, size.height);
    const float *line[4];
    size_t at[4];
    for (int k = 0; k < 4; k++)
    {
        line[k] = picture + within(y.pixel + k - 1, size.height) * size.width;
        at[k] = within(x.pixel + k - 1, size.width);
    }
    double across[4], down[4];
    weigh(x.beyond, across);
    weigh(y.beyond, down);
    const double sum = weighted_sum(line, at, across, down);
    return isfinite(sum) ? (float)sum : line[1 + (y.beyond >= 0.5)][at[1 + (x.beyond >= 0.5)]];
}

void cm_draw_moved(cm_picture_size size, const float *picture, const float *carried, double part,
                   float *moved)
{
    for (uint32_t row = 0; row < size.height; row++)
    {
        for (uint32_t column = 0; column < size.width; column++)
        {
            const size_t i = (size_t)row * size.width + column;
            moved[i] = value_at(size, picture, column - part * (double)carried[2 * i],
                                row - part * (double)carried[2 * i + 1]);
        }
    }
}

/* ---- one picture ---- */

cm_status cm_flow_warp(uint32_t width, uint32_t height, const float *picture, const float *flow,
                       double part, float *moved, float *coverage)
{
    if (picture == NULL || flow == NULL || moved == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!cm_is_picture_size(width, height) || !(fabs(part) <= PART_MOST))
    {
        return CM_ERROR_RANGE;
    }
    const cm_picture_size size = {width, height};
    const size_t pixels = cm_pixels_of(size);
    float *memory = cm_array_of(pixels, 6 * sizeof *memory);
    uint32_t *front = cm_array_of(pixels, sizeof *front);
    const int is_there = memory != NULL && front != NULL;
    if (is_there)
    {
        const cm_warp_desk desk = {front, memory};
        float *carried = memory + 3 * pixels;
        float *came = coverage == NULL ? memory + 5 * pixels : coverage;
        cm_carry_flow(size, flow, NULL, part, &desk, carried, came);
        cm_draw_moved(size, picture, carried, part, moved);
    }
    free(memory);
    free(front);
    return is_there ? CM_OK : CM_ERROR_MEMORY;
}
