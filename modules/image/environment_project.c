/* SPDX-License-Identifier: MIT
 *
 * An environment's coefficients. The texels are cut into strips by their number alone, each with sums of its own, which
 * are added in order: so threads change nothing.
 */
#include <stdlib.h>

#include "environment_levels.h"
#include "harmonics_block.h"
#include "image_jobs.h"

/* Strips have at least so many texels, and take at most so many bytes together. */
#define STRIP_TEXELS 2048
#define STRIPS_MOST 64
#define BYTES_MOST ((size_t)256 << 20)

typedef struct project_job
{
    const cm_environment *environment;
    uint32_t degree;
    size_t count;    /* of numbers in a set of coefficients */
    size_t strip;    /* texels in a strip, a multiple of CM_HARMONICS_BLOCK */
    double *partial; /* a set for each strip */
} project_job;

/* Values times solid angles, and these times cosines and sines. */
typedef struct weights
{
    double value[CM_ENVIRONMENT_CHANNELS_MAX][CM_HARMONICS_BLOCK];
    double even[CM_ENVIRONMENT_CHANNELS_MAX][CM_HARMONICS_BLOCK];
    double odd[CM_ENVIRONMENT_CHANNELS_MAX][CM_HARMONICS_BLOCK];
} weights;

/* Four sums side by side, so that they go into vectors without being reordered. */
static double dot(const double *restrict a, const double *restrict b)
{
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    for (size_t i = 0; i < CM_HARMONICS_BLOCK; i += 4)
    {
        for (size_t k = 0; k < 4; k++)
        {
            sum[k] += a[i + k] * b[i + k];
        }
    }
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/* Texels first to first + some - 1, counted through rows and faces. */
static void load_texels(const cm_environment *environment, size_t first, size_t some,
                        cm_harmonics_block *block, weights *w)
{
    const cm_level *level = &environment->level[0];
    const size_t n = level->size;
    uint8_t face[CM_HARMONICS_BLOCK];
    double x[CM_HARMONICS_BLOCK];
    double y[CM_HARMONICS_BLOCK];
    double z[CM_HARMONICS_BLOCK];
    for (size_t i = 0; i < CM_HARMONICS_BLOCK; i++)
    {
        const size_t at = i < some ? first + i : first;
        const size_t row = at / n % n;
        const size_t column = at % n;
        face[i] = (uint8_t)(at / n / n);
        x[i] = (2.0 * (double)column + 1.0) / (double)n - 1.0;
        y[i] = (2.0 * (double)row + 1.0) / (double)n - 1.0;
        const double angle =
            i < some ? cm_level_angles(environment, level, face[i])[row * n + column] : 0.0;
        const float *texel = cm_level_texel(level, face[i], (ptrdiff_t)row, (ptrdiff_t)column);
        for (size_t c = 0; c < environment->channels; c++)
        {
            w->value[c][i] = i < some ? angle * (double)texel[c] : 0.0;
        }
    }
    cm_inverse_array(environment->mapping, some, face, x, y, x, y, z);
    cm_harmonics_block_begin(block, some, x, y, z);
}

static void weigh_order(const cm_harmonics_block *block, uint32_t channels, weights *w)
{
    for (uint32_t c = 0; c < channels; c++)
    {
        for (size_t i = 0; i < CM_HARMONICS_BLOCK; i++)
        {
            w->even[c][i] = w->value[c][i] * block->cosine_m[i] / CM_HARMONICS_SCALE;
            w->odd[c][i] = w->value[c][i] * block->sine_m[i] / CM_HARMONICS_SCALE;
        }
    }
}

static void add_degree(const cm_harmonics_block *block, uint32_t channels, const weights *w,
                       double *sums)
{
    const size_t middle = (size_t)block->degree * ((size_t)block->degree + 1);
    for (uint32_t c = 0; c < channels; c++)
    {
        sums[(middle + block->order) * channels + c] += dot(block->legendre, w->even[c]);
        if (block->order > 0)
        {
            sums[(middle - block->order) * channels + c] += dot(block->legendre, w->odd[c]);
        }
    }
}

static void project_strip(size_t index, void *user)
{
    const project_job *job = user;
    const uint32_t channels = job->environment->channels;
    const size_t n = job->environment->level[0].size;
    const size_t begin = index * job->strip;
    const size_t end = begin + job->strip < 6 * n * n ? begin + job->strip : 6 * n * n;
    double *sums = job->partial + index * job->count;
    cm_harmonics_block block;
    weights w;
    for (size_t first = begin; first < end; first += CM_HARMONICS_BLOCK)
    {
        const size_t some = end - first < CM_HARMONICS_BLOCK ? end - first : CM_HARMONICS_BLOCK;
        load_texels(job->environment, first, some, &block, &w);
        for (uint32_t m = 0; m <= job->degree; m++)
        {
            weigh_order(&block, channels, &w);
            add_degree(&block, channels, &w, sums);
            while (block.degree < job->degree)
            {
                cm_harmonics_block_next_degree(&block);
                add_degree(&block, channels, &w, sums);
            }
            cm_harmonics_block_next_order(&block);
        }
    }
}

/* How many strips: by what there is to do and to store, not by threads. */
static size_t strips_of(size_t texels, size_t count)
{
    size_t strips = texels / STRIP_TEXELS + 1;
    const size_t fit = BYTES_MOST / (count * sizeof(double));
    strips = strips < STRIPS_MOST ? strips : STRIPS_MOST;
    return strips < fit ? strips : fit > 1 ? fit : 1;
}

cm_status cm_environment_project(const cm_environment *environment, uint32_t degree,
                                 unsigned threads, double *coefficients)
{
    if (environment == NULL || coefficients == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (degree > CM_HARMONICS_DEGREE_MAX)
    {
        return CM_ERROR_RANGE;
    }
    const size_t n = environment->level[0].size;
    const size_t count = cm_harmonics_count(degree) * environment->channels;
    const size_t strips = strips_of(6 * n * n, count);
    const size_t block = CM_HARMONICS_BLOCK;
    const size_t strip = (6 * n * n + strips * block - 1) / (strips * block) * block;
    project_job job = {environment, degree, count, strip, calloc(strips * count, sizeof(double))};
    if (job.partial == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_run_pieces(threads, (6 * n * n + strip - 1) / strip, project_strip, &job);
    for (size_t k = 0; k < count; k++)
    {
        double sum = 0.0;
        for (size_t s = 0; s < strips; s++)
        {
            sum += job.partial[s * count + k];
        }
        coefficients[k] = sum;
    }
    free(job.partial);
    return CM_OK;
}
