/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "environment_cells.h"

#include <math.h>
#include <stdlib.h>

#include "environment_levels.h"
#include "environment_pixels.h"
#include "image_jobs.h"

/* A texel as what it weighs. */
typedef struct cell
{
    float x;
    float y;
    float z;
    float angle;
} cell;

typedef struct cells_job
{
    const cm_environment *environment;
    float alpha_squared;
    float unit; /* weights are brought to about 1 by it */
    float
        limit; /* a cell with a solid angle of more than that times alpha^2 + s falls into its quarters */
    uint32_t top;               /* the coarsest level whose texels are quarters of none */
    cell *level[CM_LEVELS_MAX]; /* 6 faces of each level up to top */
    const cm_mapping *mapping;
    const cm_image *to;
} cells_job;

/* What has been weighed. */
typedef struct cell_sum
{
    float direction[3];
    double weight;
    double value[CM_TEXEL];
} cell_sum;

int cm_cells_suffice(const cm_environment *environment, double alpha_squared, double coarseness)
{
    const double edge = 1.5 / environment->level[0].size;
    return edge * edge <= coarseness * coarseness * alpha_squared;
}

/* ---- cells ---- */

/* A row of a level; rows of all faces are counted through. */
typedef struct fill_job
{
    const cm_environment *environment;
    const cm_level *level;
    cell *to;
} fill_job;

static void fill_row(size_t index, void *user)
{
    const fill_job *job = user;
    const size_t n = job->level->size;
    const size_t face = index / n;
    const size_t row = index % n;
    const double *angle = cm_level_angles(job->environment, job->level, face) + row * n;
    for (size_t i = 0; i < n; i++)
    {
        const double uv[2] = {(2.0 * (double)i + 1.0) / (double)n - 1.0,
                              (2.0 * (double)row + 1.0) / (double)n - 1.0};
        double d[3];
        cm_inverse(job->environment->mapping, (uint8_t)face, uv, d);
        job->to[index * n + i] = (cell){(float)d[0], (float)d[1], (float)d[2], (float)angle[i]};
    }
}

static cm_status make_cells(cells_job *job, unsigned threads)
{
    const cm_environment *environment = job->environment;
    while (job->top + 1 < environment->level_count &&
           environment->level[job->top].size == 2 * environment->level[job->top + 1].size)
    {
        job->top++;
    }
    for (uint32_t k = 0; k <= job->top; k++)
    {
        const cm_level *level = &environment->level[k];
        job->level[k] = cm_array_of((size_t)level->size * level->size, 6 * sizeof(cell));
        if (job->level[k] == NULL)
        {
            return CM_ERROR_MEMORY;
        }
        fill_job fill = {environment, level, job->level[k]};
        cm_run_pieces(threads, 6 * (size_t)level->size, fill_row, &fill);
    }
    return CM_OK;
}

/* ---- sums ---- */

/* Adds a cell, or its quarters. */
static void add_cell(const cells_job *job, uint32_t k, size_t face, size_t row, size_t column,
                     cell_sum *sum)
{
    const cm_level *level = &job->environment->level[k];
    const cell *c = &job->level[k][(face * level->size + row) * level->size + column];
    const float dx = sum->direction[0] - c->x;
    const float dy = sum->direction[1] - c->y;
    const float dz = sum->direction[2] - c->z;
    const float s = 0.25F * (dx * dx + dy * dy + dz * dz);
    const float a = job->alpha_squared;
    const float cosine = 1.0F - 2.0F * s;
    if (cosine < 0.0F && cosine * cosine > c->angle)
    {
        return; /* so far below the horizon that all of it is */
    }
    if (k > 0 && c->angle > job->limit * (a + s))
    {
        for (size_t quarter = 0; quarter < 4; quarter++)
        {
            add_cell(job, k - 1, face, 2 * row + quarter / 2, 2 * column + quarter % 2, sum);
        }
        return;
    }
    if (cosine > 0.0F)
    {
        const float share = job->unit / (a + (1.0F - a) * s);
        const double weight = (double)(cosine * share * share * c->angle);
        const float *texel = cm_level_texel(level, face, (ptrdiff_t)row, (ptrdiff_t)column);
        sum->weight += weight;
        for (size_t channel = 0; channel < CM_TEXEL; channel++)
        {
            sum->value[channel] += weight * (double)texel[channel];
        }
    }
}

/* A row of the target; rows of all faces are counted through. */
static void weigh_row(size_t index, void *user)
{
    const cells_job *job = user;
    const uint32_t n = job->to[0].width;
    const size_t top = job->environment->level[job->top].size;
    const uint8_t target = (uint8_t)(index / n);
    const uint32_t row = (uint32_t)(index % n);
    for (uint32_t column = 0; column < n; column++)
    {
        const double uv[2] = {(2.0 * column + 1.0) / n - 1.0, (2.0 * row + 1.0) / n - 1.0};
        double d[3];
        cm_inverse(job->mapping, target, uv, d);
        cell_sum sum = {{(float)d[0], (float)d[1], (float)d[2]}, 0.0, {0.0}};
        for (size_t k = 0; k < 6 * top * top; k++)
        {
            add_cell(job, job->top, k / top / top, k / top % top, k % top, &sum);
        }
        float value[CM_TEXEL];
        for (size_t channel = 0; channel < CM_TEXEL; channel++)
        {
            value[channel] = (float)(sum.value[channel] / sum.weight);
        }
        cm_pixel_store(&job->to[target], cm_face_row(job->mapping, n, row), column, value);
    }
}

cm_status cm_environment_cells(const cm_environment *environment, double alpha_squared,
                               double coarseness, const cm_mapping *mapping, unsigned threads,
                               const cm_image to[6])
{
    cells_job job = {.environment = environment, .mapping = mapping, .to = to};
    const double n = environment->level[0].size;
    job.limit = (float)(coarseness * coarseness);
    /* s of the nearest cell is about that at most: with a narrower lobe weights would be too small for numbers, and are
       as good, since that cell has them all */
    job.alpha_squared = (float)fmax(alpha_squared, 1e-6 / (n * n));
    job.unit = (float)fmax(alpha_squared, 0.25 / (n * n));
    const cm_status status = make_cells(&job, threads);
    if (status == CM_OK)
    {
        cm_run_pieces(threads, 6 * (size_t)to[0].width, weigh_row, &job);
    }
    for (uint32_t k = 0; k < CM_LEVELS_MAX; k++)
    {
        free(job.level[k]);
    }
    return status;
}
