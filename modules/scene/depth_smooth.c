/* SPDX-License-Identifier: MIT */
#include <cubemap/depth.h>

#include <float.h>
#include <stdlib.h>

#include "bands.h"
#include "ray_table.h"

#define ROWS_AT_LEAST 16
#define SIGMA_LEAST 1e-6
#define SIGMA_MOST 1e6

typedef struct smoothing
{
    const cm_rays *rays;
    const float *from;
    float *to;
    cm_smooth_weights weights;
    size_t stride; /* floats of a row of the desk */
    float *desk;   /* DESK_ROWS of each band */
} smoothing;

/* Rows of a band that are on the desk: of values, in turn, and for each row down the weights of as many rows as wait for
 * it. */
enum
{
    VALUE_ROWS = CM_SMOOTH_WIDTH,
    WEIGHT_ROWS = (CM_SMOOTH_REACH + 1) * (CM_SMOOTH_REACH + 2) / 2 * CM_SMOOTH_WIDTH,
    DESK_ROWS = VALUE_ROWS + WEIGHT_ROWS
};

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

/* A row of the image, with what is not measured told; or, beyond the face's ends, an empty one. */
static void take_row(const smoothing *s, size_t face, size_t row, float *restrict to)
{
    const size_t width = s->rays->width;
    /* rows are counted from REACH before the face on */
    const int is_there = row >= CM_SMOOTH_REACH && row < CM_SMOOTH_REACH + s->rays->face_rows;
    if (!is_there)
    {
        for (size_t i = 0; i < width; i++)
        {
            to[i] = FLT_MAX;
        }
        return;
    }
    const float *restrict from = s->from + (face + row - CM_SMOOTH_REACH) * width;
    for (size_t i = 0; i < width; i++)
    {
        to[i] = from[i] > 0.0f && from[i] <= FLT_MAX ? from[i] : FLT_MAX;
    }
}

static float *desk_row(const smoothing *s, float *desk, size_t row)
{
    return desk + row * s->stride + CM_DEPTH_SLACK;
}

/* Where a row keeps its weights with the one that is `down` below, until that needs them. */
static float *weights_of(const smoothing *s, float *desk, size_t row, size_t down)
{
    const size_t before = down * (down + 1) / 2;
    return desk_row(s, desk, VALUE_ROWS + (before + row % (down + 1)) * CM_SMOOTH_WIDTH);
}

/* All that belongs to a row, counted from the face on. */
static cm_smooth_rows rows_around(const smoothing *s, size_t row, float *desk)
{
    cm_smooth_rows rows = {.stride = s->stride};
    for (size_t j = 0; j < CM_SMOOTH_WIDTH; j++)
    {
        rows.value[j] = desk_row(s, desk, (row + j) % VALUE_ROWS);
    }
    for (size_t down = 0; down <= CM_SMOOTH_REACH; down++)
    {
        rows.own[down] = weights_of(s, desk, row, down);
        /* its turn comes next: row - down, and none is below 0 */
        rows.above[down] = weights_of(s, desk, row + 1, down);
    }
    return rows;
}

/* Values and weights of the rows before: those of rows before the face are of nothing. */
static void begin_rows(const smoothing *s, size_t face, size_t first, float *desk)
{
    const cm_rays *rays = s->rays;
    for (size_t i = 0; i < DESK_ROWS * s->stride; i++)
    {
        desk[i] = i < VALUE_ROWS * s->stride ? FLT_MAX : 0.0f;
    }
    const size_t begin = first > CM_SMOOTH_REACH ? first - CM_SMOOTH_REACH : 0;
    for (size_t row = begin; row < begin + 2 * CM_SMOOTH_REACH; row++)
    {
        take_row(s, face, row, desk_row(s, desk, row % VALUE_ROWS));
    }
    for (size_t row = begin; row < first; row++)
    {
        const size_t in = row + 2 * CM_SMOOTH_REACH;
        take_row(s, face, in, desk_row(s, desk, in % VALUE_ROWS));
        const cm_smooth_rows rows = rows_around(s, row, desk);
        for (size_t down = first - row; down <= CM_SMOOTH_REACH; down++)
        {
            rays->set->weigh(rays->width, &rows, &s->weights, down);
        }
    }
}

/* Rows first to last - 1 of a face. */
static void smooth_face(const smoothing *s, size_t face, size_t first, size_t last, float *desk)
{
    const cm_rays *rays = s->rays;
    begin_rows(s, face, first, desk);
    for (size_t row = first; row < last; row++)
    {
        const size_t in = row + 2 * CM_SMOOTH_REACH;
        take_row(s, face, in, desk_row(s, desk, in % VALUE_ROWS));
        const cm_smooth_rows rows = rows_around(s, row, desk);
        rays->set->smooth(rays->width, &rows, &s->weights, s->to + (face + row) * rays->width);
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
    const size_t bands = cm_band_count(threads, rays->height, ROWS_AT_LEAST);
    smoothing s = {.rays = rays, .from = from, .to = to};
    s.stride = cm_row_stride(rays->width);
    cm_row_desk desk;
    if (!cm_row_desk_make(bands * DESK_ROWS * s.stride, &desk))
    {
        return CM_ERROR_MEMORY;
    }
    s.desk = desk.rows;
    fill_weights(pixels, metres, &s.weights);
    cm_run_bands(bands, rays->height, ROWS_AT_LEAST, smooth_band, &s);
    free(desk.memory);
    return CM_OK;
}
