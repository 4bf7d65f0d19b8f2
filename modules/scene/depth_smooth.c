/* SPDX-License-Identifier: MIT */
#include <cubemap/depth.h>

#include <float.h>
#include <stdlib.h>

#include "bands.h"
#include "ray_table.h"

#define ROWS_AT_LEAST 16
#define SIGMA_LEAST 1e-6
#define SIGMA_MOST 1e6

/* Columns that are smoothed together, with REACH more beside: 640, whose weights stay in the second cache. Narrower strips
 * would stay in the first, and make the weights beside them twice, which takes longer. */
#define STRIP 646

typedef struct smoothing
{
    const cm_rays *rays;
    const float *from;
    float *to;
    cm_smooth_weights weights;
    size_t stride; /* floats of a row of the desk */
    float *desk;   /* DESK_ROWS of each band */
} smoothing;

/* Rows of a band that are on the desk: of values, in turn; for each row down the weights of as many rows as wait for it;
 * and two sums. */
enum
{
    VALUE_ROWS = CM_SMOOTH_WIDTH,
    WEIGHT_ROWS = (1 + CM_SMOOTH_REACH * (CM_SMOOTH_REACH + 1) / 2) * CM_SMOOTH_WIDTH,
    SUM_ROW = VALUE_ROWS + WEIGHT_ROWS,
    SUM_OF_WEIGHTS_ROW,
    DESK_ROWS
};

/* Some columns of a face. */
typedef struct strip
{
    const smoothing *all;
    size_t face;    /* its first row in the image */
    size_t column;  /* the first one that is smoothed: place REACH of rows of the desk */
    size_t columns; /* that are smoothed */
    float *desk;
} strip;

static void fill_weights(double pixels, double metres, cm_smooth_weights *weights)
{
    const double log2_of_e = 1.4426950408889634;
    for (int j = 0; j < CM_SMOOTH_WIDTH; j++)
    {
        for (int k = 0; k < CM_SMOOTH_WIDTH; k++)
        {
            const int across = k - CM_SMOOTH_REACH;
            const int down = j - CM_SMOOTH_REACH;
            const double squares = (double)(across * across + down * down);
            const double place = -log2_of_e * squares / (2.0 * pixels * pixels);
            weights->place[j][k] = place < -127.0 ? -127.0f : (float)place;
        }
    }
    weights->scale = (float)(log2_of_e / (2.0 * metres * metres));
}

static float *desk_row(const strip *s, size_t row)
{
    return s->desk + row * s->all->stride + CM_DEPTH_SLACK;
}

/* A row of the image, with what is not measured told; rows are counted from REACH before the face on. What is beyond the
 * face's ends is empty. */
static void take_row(const strip *s, size_t row)
{
    const cm_rays *rays = s->all->rays;
    float *to = desk_row(s, row % VALUE_ROWS) - CM_SMOOTH_REACH;
    const size_t count = s->columns + 4 * (size_t)CM_SMOOTH_REACH;
    const int is_there = row >= CM_SMOOTH_REACH && row < CM_SMOOTH_REACH + rays->face_rows;
    /* place i is column i + s->column - 2 REACH */
    const size_t left = 2 * (size_t)CM_SMOOTH_REACH;
    const size_t begin = s->column < left ? left - s->column : 0;
    const size_t to_end = rays->width - s->column + left;
    const size_t end = !is_there ? begin : to_end < count ? to_end : count;
    for (size_t i = 0; i < begin; i++)
    {
        to[i] = FLT_MAX;
    }
    if (is_there)
    {
        const float *from = s->all->from + (s->face + row - CM_SMOOTH_REACH) * rays->width +
                            (s->column + begin - left);
        rays->set->fill(end - begin, from, to + begin);
    }
    for (size_t i = end; i < count; i++)
    {
        to[i] = FLT_MAX;
    }
}

/* Where a row keeps its weights with the one that is `down` below: until that has read them, and writes its own there. */
static float *weights_of(const strip *s, size_t row, size_t down)
{
    const size_t place = down == 0 ? 0 : 1 + down * (down - 1) / 2 + row % down;
    return desk_row(s, VALUE_ROWS + place * CM_SMOOTH_WIDTH);
}

/* All that belongs to a row, counted from the face on. */
static cm_smooth_rows rows_around(const strip *s, size_t row)
{
    cm_smooth_rows rows = {.stride = s->all->stride,
                           .sum = desk_row(s, SUM_ROW),
                           .weight = desk_row(s, SUM_OF_WEIGHTS_ROW)};
    for (size_t j = 0; j < CM_SMOOTH_WIDTH; j++)
    {
        rows.value[j] = desk_row(s, (row + j) % VALUE_ROWS);
    }
    for (size_t down = 0; down <= CM_SMOOTH_REACH; down++)
    {
        rows.own[down] = weights_of(s, row, down);
    }
    return rows;
}

/* Values and weights of the rows before; those of rows before the face are of nothing. */
static void begin_rows(const strip *s, size_t first)
{
    const cm_depth_set *set = s->all->rays->set;
    for (size_t i = 0; i < DESK_ROWS * s->all->stride; i++)
    {
        s->desk[i] = i < VALUE_ROWS * s->all->stride ? FLT_MAX : 0.0f;
    }
    const size_t begin = first > CM_SMOOTH_REACH ? first - CM_SMOOTH_REACH : 0;
    for (size_t row = begin; row < begin + 2 * CM_SMOOTH_REACH; row++)
    {
        take_row(s, row);
    }
    for (size_t row = begin; row < first; row++)
    {
        take_row(s, row + 2 * CM_SMOOTH_REACH);
        const cm_smooth_rows rows = rows_around(s, row);
        for (size_t down = first - row; down <= CM_SMOOTH_REACH; down++)
        {
            set->weigh(s->columns + 2 * (size_t)CM_SMOOTH_REACH, &rows, &s->all->weights, down);
        }
    }
}

/* Rows first to last - 1 of a face. */
static void smooth_strip(const strip *s, size_t first, size_t last)
{
    const cm_rays *rays = s->all->rays;
    begin_rows(s, first);
    for (size_t row = first; row < last; row++)
    {
        take_row(s, row + 2 * CM_SMOOTH_REACH);
        const cm_smooth_rows rows = rows_around(s, row);
        rays->set->smooth(s->columns + 2 * (size_t)CM_SMOOTH_REACH, &rows, &s->all->weights);
        rays->set->divide(s->columns, rows.value[CM_SMOOTH_REACH] + CM_SMOOTH_REACH,
                          rows.sum + CM_SMOOTH_REACH, rows.weight + CM_SMOOTH_REACH,
                          s->all->to + (s->face + row) * rays->width + s->column);
    }
}

static void smooth_face(const smoothing *all, size_t face, size_t first, size_t last, float *desk)
{
    const size_t most = STRIP - 2 * (size_t)CM_SMOOTH_REACH;
    for (size_t column = 0; column < all->rays->width; column += most)
    {
        const size_t left = all->rays->width - column;
        const strip s = {all, face, column, left < most ? left : most, desk};
        smooth_strip(&s, first, last);
    }
}

static void smooth_band(size_t first, size_t last, size_t band, void *user)
{
    const smoothing *s = user;
    const size_t rows = s->rays->face_rows;
    float *desk = s->desk + band * DESK_ROWS * s->stride;
    while (first < last)
    {
        const size_t face = first - first % rows;
        const size_t end = face + rows < last ? face + rows : last;
        smooth_face(s, face, first - face, end - face, desk);
        first = end;
    }
}

static int is_sigma(double sigma)
{
    return sigma >= SIGMA_LEAST && sigma <= SIGMA_MOST;
}

cm_status cm_depth_smooth(const cm_rays *rays, const float *from, double pixels, double metres,
                          unsigned threads, float *to)
{
    if (rays == NULL || from == NULL || to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!is_sigma(pixels) || !is_sigma(metres))
    {
        return CM_ERROR_RANGE;
    }
    const size_t bands = cm_band_count(rays->pool, threads, rays->height, ROWS_AT_LEAST);
    smoothing s = {.rays = rays, .from = from, .to = to};
    s.stride = cm_row_stride(STRIP);
    cm_row_desk desk;
    if (!cm_row_desk_make(bands * DESK_ROWS * s.stride, &desk))
    {
        return CM_ERROR_MEMORY;
    }
    s.desk = desk.rows;
    fill_weights(pixels, metres, &s.weights);
    cm_run_bands(rays->pool, bands, rays->height, ROWS_AT_LEAST, smooth_band, &s);
    free(desk.memory);
    return CM_OK;
}
