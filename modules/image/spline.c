/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "spline.h"
#include "filter_set.h"
#include "large_memory.h"
#include "spline_holes.h"

#include <cubemap/threads.h>

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

typedef struct spline_job
{
    const cm_padded *padded;
    const cm_filter_set *set;
    size_t high;   /* rows with their border */
    size_t floats; /* of a row with its border */
    atomic_int failed;
} spline_job;

static float *corner_of(const cm_padded *padded, size_t plane)
{
    return padded->memory + plane * padded->plane_floats;
}

static void do_rows(size_t begin, size_t end, void *user)
{
    spline_job *job = user;
    const cm_padded *padded = job->padded;
    float *desk = cm_array_of(job->floats, CM_BUNDLE_ROWS * sizeof(float));
    if (desk == NULL)
    {
        atomic_store(&job->failed, CM_ERROR_MEMORY);
        return;
    }
    const size_t per_plane = (job->high + CM_BUNDLE_ROWS - 1) / CM_BUNDLE_ROWS;
    for (size_t at = begin / CM_TASK; at < end / CM_TASK; at++)
    {
        const size_t row = at % per_plane * CM_BUNDLE_ROWS;
        const size_t rows = job->high - row < CM_BUNDLE_ROWS ? job->high - row : CM_BUNDLE_ROWS;
        job->set->spline_rows(corner_of(padded, at / per_plane) + row * (size_t)padded->row, rows,
                              padded->row, job->floats, padded->channels, desk);
        cm_large_touched(padded->owner, rows * (size_t)padded->row * sizeof(float));
    }
    free(desk);
}

static void do_columns(size_t begin, size_t end, void *user)
{
    spline_job *job = user;
    const cm_padded *padded = job->padded;
    const size_t per_plane = (job->floats + CM_BUNDLE_COLUMNS - 1) / CM_BUNDLE_COLUMNS;
    for (size_t at = begin / CM_TASK; at < end / CM_TASK; at++)
    {
        const size_t first = at % per_plane * CM_BUNDLE_COLUMNS;
        const size_t left = job->floats - first;
        job->set->spline_columns(corner_of(padded, at / per_plane) + first,
                                 left < CM_BUNDLE_COLUMNS ? left : CM_BUNDLE_COLUMNS, job->high,
                                 padded->row);
    }
}

/* ---- planes that the caller keeps, in files say ----
 *
 * A walk down a few columns touches all pages of a plane, again and again: so rows are read one after another, all columns
 * of some before the next, and what the recursions have reached is kept. */

#define PART_ROWS 64

typedef struct part_job
{
    const spline_job *all;
    float *first; /* of the plane's part */
    size_t rows;
    cm_spline_way way;
    int is_begin;
    float *state; /* 2 * CM_BUNDLE_COLUMNS for each bundle */
} part_job;

static void do_part(size_t begin, size_t end, void *user)
{
    const part_job *job = user;
    for (size_t at = begin / CM_TASK; at < end / CM_TASK; at++)
    {
        const size_t first = at * CM_BUNDLE_COLUMNS;
        const size_t left = job->all->floats - first;
        job->all->set->spline_columns_part(job->first + first,
                                           left < CM_BUNDLE_COLUMNS ? left : CM_BUNDLE_COLUMNS,
                                           job->rows, job->all->padded->row, job->way,
                                           job->is_begin, job->state + at * 2 * CM_BUNDLE_COLUMNS);
        cm_large_touched(job->all->padded->owner, job->rows * CM_BUNDLE_COLUMNS * sizeof(float));
    }
}

static void do_plane(const spline_job *all, size_t plane, cm_spline_way way, unsigned threads,
                     float *state)
{
    const size_t parts = (all->high + PART_ROWS - 1) / PART_ROWS;
    const size_t bundles = (all->floats + CM_BUNDLE_COLUMNS - 1) / CM_BUNDLE_COLUMNS;
    for (size_t i = 0; i < parts; i++)
    {
        const size_t row = (way == CM_SPLINE_FORTH ? i : parts - 1 - i) * PART_ROWS;
        part_job job = {.all = all, .way = way, .is_begin = i == 0, .state = state};
        job.first = corner_of(all->padded, plane) + row * (size_t)all->padded->row;
        job.rows = all->high - row < PART_ROWS ? all->high - row : PART_ROWS;
        cm_run_threads(threads, bundles * CM_TASK, CM_TASK, do_part, &job);
    }
}

static cm_status do_planes(const spline_job *all, unsigned threads)
{
    const size_t bundles = (all->floats + CM_BUNDLE_COLUMNS - 1) / CM_BUNDLE_COLUMNS;
    float *state = cm_array_of(bundles, 2 * CM_BUNDLE_COLUMNS * sizeof(float));
    for (size_t plane = 0; state != NULL && plane < all->padded->planes; plane++)
    {
        do_plane(all, plane, CM_SPLINE_FORTH, threads, state);
        do_plane(all, plane, CM_SPLINE_BACK, threads, state);
    }
    free(state);
    return state == NULL ? CM_ERROR_MEMORY : CM_OK;
}

static cm_status filter(spline_job *job, unsigned threads)
{
    const cm_padded *padded = job->padded;
    const size_t bundles = (job->high + CM_BUNDLE_ROWS - 1) / CM_BUNDLE_ROWS;
    const size_t stripes = (job->floats + CM_BUNDLE_COLUMNS - 1) / CM_BUNDLE_COLUMNS;
    cm_run_threads(threads, padded->planes * bundles * CM_TASK, CM_TASK, do_rows, job);
    const cm_status status = (cm_status)atomic_load(&job->failed);
    if (status != CM_OK || padded->owner != NULL)
    {
        return status != CM_OK ? status : do_planes(job, threads);
    }
    cm_run_threads(threads, padded->planes * stripes * CM_TASK, CM_TASK, do_columns, job);
    return CM_OK;
}

void cm_spline_look_at(const cm_padded *padded, const cm_values *values, cm_level *level)
{
    memset(level, 0, sizeof *level);
    level->values = values;
    level->planes = padded->planes;
    level->width = padded->width;
    level->height = padded->height;
    level->channels = padded->channels;
    level->pixel_size = padded->channels * sizeof(float);
    level->is_plain = 1;
    level->reach = padded->beside < padded->beyond ? padded->beside : padded->beyond;
    for (unsigned plane = 0; plane < padded->planes; plane++)
    {
        cm_level_plane *to = &level->plane[plane];
        to->pixels = (const unsigned char *)padded->first[plane];
        to->row_stride = padded->row * (ptrdiff_t)sizeof(float);
        to->pixel_stride = (ptrdiff_t)level->pixel_size;
        to->end = (const unsigned char *)padded->memory;
        if (padded->memory != NULL)
        {
            to->end += padded->planes * padded->plane_floats * sizeof(float);
        }
    }
}

cm_status cm_spline_make(const cm_surface *surface, const cm_image *pictures,
                         const cm_values *values, const cm_sample_set *set, const cm_memory *memory,
                         unsigned threads, cm_padded *coefficients, cm_level *level)
{
    const int32_t border = CM_SPLINE_START + CM_FILTER_TAPS_MAX / 2;
    cm_status status =
        cm_padded_create(surface, surface->width, surface->height, values->working, border, border,
                         CM_PADDED_PIXELS, memory, threads, coefficients);
    if (status != CM_OK)
    {
        return status;
    }
    uint64_t *holes = NULL;
    const cm_filter_set *loops = cm_filter_set_find(set->name);
    const int may_have_holes = values->type == CM_PIXEL_HALF || values->type == CM_PIXEL_FLOAT;
    int has_holes = 0;
    status = cm_padded_load(coefficients, surface, pictures, values, set, threads, CM_SPLINE_MOST,
                            may_have_holes ? &has_holes : NULL);
    if (status == CM_OK && may_have_holes)
    {
        status = cm_spline_holes_fill(coefficients, surface, loops, has_holes, threads, &holes);
    }
    spline_job job = {.padded = coefficients, .set = loops};
    job.high = coefficients->height + 2 * (size_t)coefficients->beyond;
    job.floats = (coefficients->width + 2 * (size_t)coefficients->beside) * values->working;
    atomic_init(&job.failed, (int)status);
    status = status == CM_OK ? filter(&job, threads) : status;
    if (status == CM_OK)
    {
        cm_spline_holes_put(coefficients, holes);
    }
    free(holes);
    if (status != CM_OK)
    {
        cm_padded_free(coefficients);
        return status;
    }
    cm_spline_look_at(coefficients, values, level);
    return CM_OK;
}
