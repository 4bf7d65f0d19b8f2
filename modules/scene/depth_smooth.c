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
    float *desk;   /* CM_SMOOTH_WIDTH rows of each band, in turn */
} smoothing;

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

/* A row with what is not measured told, and such pixels beyond its ends. */
static void copy_row(const smoothing *s, size_t row, float *restrict to)
{
    const size_t width = s->rays->width;
    const float *restrict from = s->from + row * width;
    for (size_t i = 0; i < CM_SMOOTH_REACH; i++)
    {
        to[i] = FLT_MAX;
    }
    for (size_t i = 0; i < width; i++)
    {
        to[CM_SMOOTH_REACH + i] = from[i] > 0.0f && from[i] <= FLT_MAX ? from[i] : FLT_MAX;
    }
    for (size_t i = CM_SMOOTH_REACH + width; i < s->stride; i++)
    {
        to[i] = FLT_MAX;
    }
}

static void clear_row(const smoothing *s, float *to)
{
    for (size_t i = 0; i < s->stride; i++)
    {
        to[i] = FLT_MAX;
    }
}

/* Rows from a face on, as many before and behind as the filter reaches: those beyond the face's ends are empty. */
static void smooth_face(const smoothing *s, size_t face, size_t first, size_t last, float *desk)
{
    const size_t end = face + s->rays->face_rows;
    const float *rows[CM_SMOOTH_WIDTH];
    for (size_t row = first; row < last + 2 * CM_SMOOTH_REACH; row++)
    {
        /* the row that comes in is wanted - REACH */
        float *in = desk + row % CM_SMOOTH_WIDTH * s->stride;
        if (row < face + CM_SMOOTH_REACH || row >= end + CM_SMOOTH_REACH)
        {
            clear_row(s, in);
        }
        else
        {
            copy_row(s, row - CM_SMOOTH_REACH, in);
        }
        if (row >= first + 2 * CM_SMOOTH_REACH)
        {
            const size_t at = row - 2 * CM_SMOOTH_REACH;
            for (size_t j = 0; j < CM_SMOOTH_WIDTH; j++)
            {
                rows[j] = desk + (at + j) % CM_SMOOTH_WIDTH * s->stride;
            }
            s->rays->set->smooth(s->rays->width, rows, &s->weights, s->to + at * s->rays->width);
        }
    }
}

static void smooth_band(size_t first, size_t last, size_t band, void *user)
{
    const smoothing *s = user;
    const size_t rows = s->rays->face_rows;
    float *desk = s->desk + band * CM_SMOOTH_WIDTH * s->stride;
    while (first < last)
    {
        const size_t face = first - first % rows;
        const size_t end = face + rows < last ? face + rows : last;
        smooth_face(s, face, first, end, desk);
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
    s.stride = rays->width + (size_t)(2 * CM_SMOOTH_REACH + CM_DEPTH_SLACK);
    s.desk = malloc(bands * CM_SMOOTH_WIDTH * s.stride * sizeof *s.desk);
    if (s.desk == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    fill_weights(pixels, metres, &s.weights);
    cm_run_bands(bands, rays->height, ROWS_AT_LEAST, smooth_band, &s);
    free(s.desk);
    return CM_OK;
}
