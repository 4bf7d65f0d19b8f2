/* SPDX-License-Identifier: MIT */
#include "spline_holes.h"

#include <cubemap/threads.h>

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

typedef struct hole_job
{
    const cm_padded *padded;
    uint64_t *bits; /* one a float, plane by plane */
    size_t words;   /* of a plane */
    atomic_int found;
} hole_job;

static size_t rows_of(const cm_padded *padded)
{
    return padded->height + 2 * (size_t)padded->beyond;
}

static size_t floats_of(const cm_padded *padded)
{
    return (padded->width + 2 * (size_t)padded->beside) * padded->channels;
}

static float *row_of(const cm_padded *padded, size_t at)
{
    return padded->memory + at / rows_of(padded) * padded->plane_floats +
           at % rows_of(padded) * (size_t)padded->row;
}

static int is_hole(float value)
{
    return !(fabsf(value) <= CM_SPLINE_MOST);
}

static int has_hole(const float *from, size_t n)
{
    int found = 0;
    for (size_t i = 0; i < n; i++)
    {
        found |= is_hole(from[i]);
    }
    return found;
}

/* At the border's rows, and at the ends of all others. */
static void look(size_t begin, size_t end, void *user)
{
    hole_job *job = user;
    const cm_padded *padded = job->padded;
    const size_t floats = floats_of(padded);
    const size_t beside = (size_t)padded->beside * padded->channels;
    for (size_t at = begin; at < end; at++)
    {
        const float *row = row_of(padded, at);
        const size_t line = at % rows_of(padded);
        const int is_border =
            line < (size_t)padded->beyond || line >= (size_t)padded->beyond + padded->height;
        const int found = is_border
                              ? has_hole(row, floats)
                              : has_hole(row, beside) | has_hole(row + floats - beside, beside);
        if (found)
        {
            atomic_store(&job->found, 1);
        }
    }
}

static void blank(size_t begin, size_t end, void *user)
{
    const hole_job *job = user;
    const size_t floats = floats_of(job->padded);
    for (size_t at = begin; at < end; at++)
    {
        float *row = row_of(job->padded, at);
        for (size_t i = 0; i < floats; i++)
        {
            row[i] = is_hole(row[i]) ? (float)NAN : row[i];
        }
    }
}

/* ---- filling ---- */

/* The mean of what is known of one before and one above, or of one after and one below. */
typedef struct mean
{
    float sum;
    float count;
} mean;

static void add(mean *to, float value, float weight)
{
    if (!is_hole(value))
    {
        to->sum += weight * value;
        to->count += weight;
    }
}

/* Forth: from the left and from above, which are filled already. */
static void fill_forth(const hole_job *job, size_t plane)
{
    const cm_padded *padded = job->padded;
    const size_t rows = rows_of(padded), floats = floats_of(padded), step = padded->channels;
    uint64_t *bits = job->bits + plane * job->words;
    for (size_t row = 0; row < rows; row++)
    {
        float *at = row_of(padded, plane * rows + row);
        for (size_t i = 0; i < floats; i++)
        {
            if (!is_hole(at[i]))
            {
                continue;
            }
            const size_t bit = row * floats + i;
            mean known = {0.0f, 0.0f};
            bits[bit / 64] |= (uint64_t)1 << (bit % 64);
            if (i >= step)
            {
                add(&known, at[i - step], 1.0f);
            }
            if (row > 0)
            {
                add(&known, at[(ptrdiff_t)i - padded->row], 1.0f);
            }
            at[i] = known.count > 0.0f ? known.sum / known.count : (float)NAN;
        }
    }
}

/* Back: so much from what came from before as from the right and from below. */
static void fill_back(const hole_job *job, size_t plane)
{
    const cm_padded *padded = job->padded;
    const size_t rows = rows_of(padded), floats = floats_of(padded), step = padded->channels;
    const uint64_t *bits = job->bits + plane * job->words;
    for (size_t row = rows; row-- > 0;)
    {
        float *at = row_of(padded, plane * rows + row);
        for (size_t i = floats; i-- > 0;)
        {
            const size_t bit = row * floats + i;
            if ((bits[bit / 64] >> (bit % 64) & 1u) == 0)
            {
                continue;
            }
            mean known = {0.0f, 0.0f};
            add(&known, at[i], 2.0f);
            if (i + step < floats)
            {
                add(&known, at[i + step], 1.0f);
            }
            if (row + 1 < rows)
            {
                add(&known, at[(ptrdiff_t)i + padded->row], 1.0f);
            }
            at[i] = known.count > 0.0f ? known.sum / known.count : 0.0f;
        }
    }
}

static void fill_planes(size_t begin, size_t end, void *user)
{
    for (size_t at = begin / CM_TASK; at < end / CM_TASK; at++)
    {
        fill_forth(user, at);
        fill_back(user, at);
    }
}

cm_status cm_spline_holes_fill(const cm_padded *padded, const cm_surface *surface,
                               const cm_filter_set *set, int has_holes, unsigned threads,
                               uint64_t **holes)
{
    hole_job job = {.padded = padded};
    job.words = (rows_of(padded) * floats_of(padded) + 63) / 64;
    atomic_init(&job.found, has_holes);
    if (!has_holes)
    {
        cm_run_threads(threads, padded->planes * rows_of(padded), 64, look, &job);
    }
    if (!atomic_load(&job.found))
    {
        *holes = NULL;
        return CM_OK;
    }
    job.bits = calloc(padded->planes * job.words, sizeof *job.bits);
    if (job.bits == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    /* a very large number times a very small weight is no hole, and far from true */
    cm_run_threads(threads, padded->planes * rows_of(padded), 64, blank, &job);
    if (!surface->has_gaps)
    {
        cm_padded_border(padded, surface, set, threads);
    }
    cm_run_threads(threads, (size_t)padded->planes * CM_TASK, CM_TASK, fill_planes, &job);
    *holes = job.bits;
    return CM_OK;
}

void cm_spline_holes_put(const cm_padded *padded, const uint64_t *holes)
{
    const size_t rows = rows_of(padded), floats = floats_of(padded);
    const size_t words = (rows * floats + 63) / 64;
    for (size_t at = 0; holes != NULL && at < padded->planes * words; at++)
    {
        for (size_t k = 0; k < 64 && holes[at] >> k != 0; k++)
        {
            const size_t bit = at % words * 64 + k;
            if (holes[at] >> k & 1u)
            {
                row_of(padded, at / words * rows + bit / floats)[bit % floats] = (float)NAN;
            }
        }
    }
}
