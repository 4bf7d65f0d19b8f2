/* SPDX-License-Identifier: MIT */
#include <cubemap/depth.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bands.h"

typedef struct cleaning
{
    const char *data; /* the first pixel */
    ptrdiff_t row_stride;
    ptrdiff_t pixel_stride;
    cm_pixel_type type;
    size_t width;
    double unit;
    float nearest; /* above 0 */
    float farthest;
    float *depth;
    cm_depth_count *counts; /* of the bands */
} cleaning;

static int has_limits(const cm_depth_limits *limits)
{
    return limits->unit > 0.0 && limits->unit <= DBL_MAX && limits->nearest >= 0.0 &&
           limits->nearest <= DBL_MAX && limits->farthest >= 0.0 && limits->farthest <= DBL_MAX &&
           (limits->farthest == 0.0 || limits->farthest >= limits->nearest);
}

static int is_depth(const cm_image *picture)
{
    return (picture->type == CM_PIXEL_U16 || picture->type == CM_PIXEL_FLOAT) &&
           picture->channels == 1 && picture->width > 0 && picture->height > 0;
}

/* A limit that a float is compared with: what is rounded to it still counts. */
static float limit_of(double limit, double none)
{
    const double wanted = limit == 0.0 ? none : limit;
    return wanted >= FLT_MAX ? FLT_MAX : wanted <= FLT_TRUE_MIN ? FLT_TRUE_MIN : (float)wanted;
}

static void read_row(const cleaning *c, const char *from, float *to)
{
    const ptrdiff_t step = c->pixel_stride;
    if (c->type == CM_PIXEL_FLOAT && step == (ptrdiff_t)sizeof(float))
    {
        const float *dense = (const float *)(const void *)from;
        for (size_t i = 0; i < c->width; i++)
        {
            to[i] = (float)((double)dense[i] * c->unit);
        }
        return;
    }
    if (c->type == CM_PIXEL_U16 && step == (ptrdiff_t)sizeof(uint16_t))
    {
        const uint16_t *dense = (const uint16_t *)(const void *)from;
        for (size_t i = 0; i < c->width; i++)
        {
            to[i] = (float)(dense[i] * c->unit);
        }
        return;
    }
    for (size_t i = 0; i < c->width; i++)
    {
        const void *pixel = from + (ptrdiff_t)i * step;
        const double value = c->type == CM_PIXEL_U16 ? (double)*(const uint16_t *)pixel
                                                     : (double)*(const float *)pixel;
        to[i] = (float)(value * c->unit);
    }
}

static uint32_t count_valid(const cleaning *c, const float *value)
{
    const float nearest = c->nearest, farthest = c->farthest;
    uint32_t valid = 0;
    for (size_t i = 0; i < c->width; i++)
    {
        valid += (uint32_t)(value[i] >= nearest) & (uint32_t)(value[i] <= farthest);
    }
    return valid;
}

/* Floats that lie close, and elsewhere than they are to be. In metres they are what they should be. */
static uint32_t copy_row(const cleaning *c, const float *restrict from, float *restrict to)
{
    const float nearest = c->nearest, farthest = c->farthest;
    uint32_t valid = 0;
    for (size_t i = 0; i < c->width; i++)
    {
        const float value = from[i];
        to[i] = value;
        valid += (uint32_t)(value >= nearest) & (uint32_t)(value <= farthest);
    }
    return valid;
}

/* Returns how many are valid. */
static uint32_t take_row(const cleaning *c, size_t row, float *to)
{
    const char *from = c->data + (ptrdiff_t)row * c->row_stride;
    const int is_metres =
        c->type == CM_PIXEL_FLOAT && c->unit == 1.0 && c->pixel_stride == (ptrdiff_t)sizeof(float);
    if (is_metres && from != (const char *)to)
    {
        return copy_row(c, (const float *)(const void *)from, to);
    }
    if (!is_metres)
    {
        read_row(c, from, to);
    }
    return count_valid(c, to);
}

/* How many of a row are which kind: 32 bits, as vectors count. */
typedef struct row_count
{
    uint32_t zero, nan, infinite, negative, near, far;
} row_count;

/* Why values are no measurements; without a branch, which invalid pixels here and there would make slow. */
static void count_kinds(const cleaning *c, const float *value, cm_depth_count *all)
{
    const float nearest = c->nearest, farthest = c->farthest;
    row_count count = {0};
    for (size_t i = 0; i < c->width; i++)
    {
        const float v = value[i];
        count.zero += (uint32_t)(v == 0.0f);
        count.nan += (uint32_t)(v != v);
        count.infinite += (uint32_t)(fabsf(v) > FLT_MAX);
        count.negative += (uint32_t)(v < 0.0f) & (uint32_t)(v >= -FLT_MAX);
        count.near += (uint32_t)(v > 0.0f) & (uint32_t)(v < nearest);
        count.far += (uint32_t)(v > farthest) & (uint32_t)(v <= FLT_MAX);
    }
    all->zero += count.zero;
    all->nan += count.nan;
    all->infinite += count.infinite;
    all->negative += count.negative;
    all->near += count.near;
    all->far += count.far;
}

static void clean_band(size_t first, size_t last, size_t band, void *user)
{
    const cleaning *c = user;
    const float nearest = c->nearest, farthest = c->farthest;
    cm_depth_count count = {.size = sizeof count};
    for (size_t row = first; row < last; row++)
    {
        float *to = c->depth + row * c->width;
        const uint32_t valid = take_row(c, row, to);
        count.valid += valid;
        if (valid == c->width)
        {
            continue;
        }
        count_kinds(c, to, &count);
        for (size_t i = 0; i < c->width; i++)
        {
            to[i] = to[i] >= nearest && to[i] <= farthest ? to[i] : NAN;
        }
    }
    c->counts[band] = count;
}

static void add_counts(const cm_depth_count *from, cm_depth_count *to)
{
    to->valid += from->valid;
    to->zero += from->zero;
    to->nan += from->nan;
    to->infinite += from->infinite;
    to->negative += from->negative;
    to->near += from->near;
    to->far += from->far;
}

cm_status cm_depth_clean(const cm_image *picture, const cm_depth_limits *limits, unsigned threads,
                         float *depth, cm_depth_count *count)
{
    if (picture == NULL || picture->size != sizeof *picture || picture->data == NULL ||
        limits == NULL || limits->size != sizeof *limits || depth == NULL ||
        (count != NULL && count->size != sizeof *count))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!is_depth(picture) || !has_limits(limits))
    {
        return CM_ERROR_RANGE;
    }
    const ptrdiff_t size = (ptrdiff_t)cm_pixel_size(picture->type);
    const ptrdiff_t step = picture->pixel_stride == 0 ? size : picture->pixel_stride;
    const size_t bands = cm_band_count(NULL, threads, picture->height, 16);
    cleaning c = {.data = picture->data,
                  .row_stride = picture->row_stride == 0 ? step * (ptrdiff_t)picture->width
                                                         : picture->row_stride,
                  .pixel_stride = step,
                  .type = picture->type,
                  .width = picture->width,
                  .unit = limits->unit,
                  .nearest = limit_of(limits->nearest, 0.0),
                  .farthest = limit_of(limits->farthest, FLT_MAX),
                  .depth = depth,
                  .counts = calloc(bands, sizeof *c.counts)};
    if (c.counts == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_run_bands(NULL, bands, picture->height, 16, clean_band, &c);
    cm_depth_count all = {.size = sizeof all};
    for (size_t i = 0; i < bands; i++)
    {
        add_counts(&c.counts[i], &all);
    }
    free(c.counts);
    if (count != NULL)
    {
        *count = all;
    }
    return CM_OK;
}
