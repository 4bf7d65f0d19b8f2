/* SPDX-License-Identifier: MIT
 *
 * Levels by a sinc in a Kaiser window, whose edge is at the new level's highest frequency: J. F. Kaiser, Nonrecursive
 * digital filter design using the I0-sinh window function, IEEE Symposium on Circuits and Systems, 1974. It reaches three
 * new pixels each way, its stop band is 50 dB down; sizes that are odd have weights for each pixel.
 */
#include "pyramid.h"
#include "filter_set.h"

#include <cubemap/threads.h>

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

/* New pixels each way, and the window's parameter: 0.5842 (A - 21)^0.4 + 0.07886 (A - 21) for A = 50 dB. */
#define RADIUS 3.0
#define WINDOW 4.533514

/* The modified Bessel function of order 0, by its series. */
static double bessel_i0(double x)
{
    double sum = 1.0;
    double term = 1.0;
    for (int k = 1; k < 40; k++)
    {
        term *= 0.25 * x * x / ((double)k * k);
        sum += term;
    }
    return sum;
}

static double low_pass(double x)
{
    const double inside = 1.0 - x * x / (RADIUS * RADIUS);
    const double sinc = x == 0.0 ? 1.0 : sin(PI * x) / (PI * x);
    return inside > 0.0 ? sinc * bessel_i0(WINDOW * sqrt(inside)) : 0.0;
}

uint32_t cm_half_size(uint32_t size)
{
    return size / 2 + size % 2;
}

unsigned cm_level_count(uint32_t width, uint32_t height)
{
    unsigned count = 1;
    for (; width > 1 || height > 1; count++)
    {
        width = cm_half_size(width);
        height = cm_half_size(height);
    }
    return count;
}

/* Where each new pixel's taps begin, and their weights. NULL if there is no memory. */
static cm_half_taps *make_taps(uint32_t from, uint32_t to)
{
    cm_half_taps *taps = malloc(to * sizeof *taps);
    const double ratio = (double)from / to;
    for (uint32_t i = 0; taps != NULL && i < to; i++)
    {
        const double centre = (i + 0.5) * ratio - 0.5;
        double weight[CM_HALF_TAPS];
        double sum = 0.0;
        taps[i].first = (int32_t)floor(centre) - (CM_HALF_TAPS / 2 - 1);
        if (i > 0 && from == 2 * to)
        {
            /* all are as far from their centres */
            memcpy(taps[i].weight, taps[0].weight, sizeof taps[i].weight);
            continue;
        }
        for (int k = 0; k < CM_HALF_TAPS; k++)
        {
            weight[k] = low_pass((taps[i].first + k - centre) / ratio);
            sum += weight[k];
        }
        for (int k = 0; k < CM_HALF_TAPS; k++)
        {
            taps[i].weight[k] = (float)(weight[k] / sum);
        }
    }
    return taps;
}

typedef struct halve_job
{
    const cm_padded *from;
    const cm_padded *to;
    const cm_filter_set *set;
    cm_half_taps *columns;
    cm_half_taps *rows;
    atomic_int failed;
} halve_job;

/* Rows of the new level, of all planes. */
static void do_rows(size_t begin, size_t end, void *user)
{
    halve_job *job = user;
    const cm_padded *from = job->from;
    const cm_padded *to = job->to;
    const size_t margin = CM_HALF_TAPS / 2;
    const size_t wide = from->width + 2 * margin;
    float *desk = malloc((2 * wide + 64) * sizeof(float));
    if (desk == NULL)
    {
        atomic_store(&job->failed, CM_ERROR_MEMORY);
        return;
    }
    for (size_t at = begin; at < end; at++)
    {
        const size_t plane = at / to->height;
        const size_t row = at % to->height;
        const cm_half_taps *taps = &job->rows[row];
        for (uint32_t c = 0; c < to->channels; c++)
        {
            const float *first = from->first[plane] + taps->first * from->row + c * from->channel -
                                 (ptrdiff_t)margin;
            job->set->mix_rows(first, from->row, taps->weight, wide, desk);
            job->set->halve_row(desk, wide, job->columns, from->width == 2 * to->width, to->width,
                                to->first[plane] + (ptrdiff_t)row * to->row + c * to->channel);
        }
    }
    free(desk);
}

static cm_status halve(const cm_padded *from, const cm_padded *to, const cm_filter_set *set,
                       unsigned threads)
{
    halve_job job = {.from = from, .to = to, .set = set};
    job.columns = make_taps(from->width, to->width);
    job.rows = make_taps(from->height, to->height);
    atomic_init(&job.failed, job.columns == NULL || job.rows == NULL ? CM_ERROR_MEMORY : CM_OK);
    if (atomic_load(&job.failed) == CM_OK)
    {
        cm_run_threads(threads, (size_t)to->planes * to->height, 64, do_rows, &job);
    }
    free(job.columns);
    free(job.rows);
    return (cm_status)atomic_load(&job.failed);
}

static cm_status make_level(const cm_surface *surface, uint32_t width, uint32_t height,
                            uint32_t channels, const cm_memory *memory, unsigned threads,
                            cm_padded *level)
{
    const int32_t beside = surface->period != 0.0 ? CM_PYRAMID_BESIDE : CM_PYRAMID_BORDER;
    return cm_padded_create(surface, width, height, channels, beside, CM_PYRAMID_BORDER,
                            CM_PADDED_CHANNELS, memory, threads, level);
}

cm_status cm_pyramid_make(const cm_surface *surface, const cm_image *pictures,
                          const cm_values *values, const cm_sample_set *set, unsigned count,
                          const cm_memory *memory, unsigned threads, cm_pyramid *pyramid)
{
    const cm_filter_set *loops = cm_filter_set_find(set->name);
    memset(pyramid, 0, sizeof *pyramid);
    cm_status status = make_level(surface, surface->width, surface->height, values->working, memory,
                                  threads, &pyramid->level[0]);
    pyramid->count = 1;
    if (status == CM_OK)
    {
        status = cm_padded_load(&pyramid->level[0], surface, pictures, values, set, threads);
    }
    while (status == CM_OK && pyramid->count < count)
    {
        const cm_padded *above = &pyramid->level[pyramid->count - 1];
        cm_padded *level = &pyramid->level[pyramid->count++];
        status = make_level(surface, cm_half_size(above->width), cm_half_size(above->height),
                            values->working, memory, threads, level);
        status = status == CM_OK ? halve(above, level, loops, threads) : status;
        if (status == CM_OK)
        {
            cm_padded_border(level, surface, threads);
        }
    }
    if (status != CM_OK)
    {
        cm_pyramid_free(pyramid);
    }
    return status;
}

void cm_pyramid_free(cm_pyramid *pyramid)
{
    for (unsigned i = 0; i < pyramid->count; i++)
    {
        cm_padded_free(&pyramid->level[i]);
    }
    pyramid->count = 0;
}
