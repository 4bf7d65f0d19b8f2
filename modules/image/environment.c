/* SPDX-License-Identifier: MIT
 *
 * The life of an environment.
 */
#include <math.h>
#include <stdlib.h>

#include "modules/memory/checked_size.h"
#include "environment_angles.h"
#include "environment_levels.h"
#include "environment_pixels.h"
#include "image_jobs.h"

uint32_t cm_environment_size(const cm_environment *environment)
{
    return environment->level[0].size;
}

uint32_t cm_environment_channels(const cm_environment *environment)
{
    return environment->channels;
}

uint32_t cm_environment_level_count(const cm_environment *environment)
{
    return environment->level_count;
}

void cm_environment_destroy(cm_environment *environment)
{
    if (environment == NULL)
    {
        return;
    }
    for (size_t k = 0; k < CM_LEVELS_MAX; k++)
    {
        free(environment->level[k].texels);
        free(environment->level[k].angle);
    }
    free(environment->edge);
    free(environment);
}

/* ---- the finest level ---- */

typedef struct load_job
{
    const cm_environment *environment;
    const cm_image *faces;
} load_job;

/* Rows of all faces are counted through. */
static void load_row(size_t index, void *user)
{
    const load_job *job = user;
    const cm_level *level = &job->environment->level[0];
    const size_t face = index / level->size;
    const uint32_t row = (uint32_t)(index % level->size);
    const uint32_t from = cm_face_row(job->environment->mapping, level->size, row);
    for (uint32_t column = 0; column < level->size; column++)
    {
        float *to = cm_level_texel(level, face, (ptrdiff_t)row, (ptrdiff_t)column);
        to[0] = to[1] = to[2] = to[3] = 0.0F;
        cm_pixel_load(&job->faces[face], from, column, to);
    }
}

/* ---- the coarser ones ---- */

typedef struct halve_job
{
    const cm_environment *environment;
    const cm_level *from;
    const cm_level *to;
} halve_job;

/* How much of the fine texel i, from 0 to 1, is in the coarse one that begins and ends there. */
static double share(size_t i, double begin, double end)
{
    return fmin((double)i + 1.0, end) - fmax((double)i, begin);
}

/* The mean of what is in a coarse texel, by solid angle. Returns the solid angle. */
static double mean_texel(const halve_job *job, size_t face, size_t row, size_t column)
{
    const uint32_t n = job->from->size;
    const double ratio = (double)n / job->to->size;
    const double low = (double)row * ratio;
    const double left = (double)column * ratio;
    const double high = fmin(low + ratio, n);
    const double right = fmin(left + ratio, n);
    const double *angle = cm_level_angles(job->environment, job->from, face);
    double sum[CM_TEXEL] = {0.0, 0.0, 0.0, 0.0};
    double whole = 0.0;
    for (size_t j = (size_t)low; (double)j < high; j++)
    {
        for (size_t i = (size_t)left; (double)i < right; i++)
        {
            const double weight = angle[j * n + i] * share(j, low, high) * share(i, left, right);
            const float *texel = cm_level_texel(job->from, face, (ptrdiff_t)j, (ptrdiff_t)i);
            whole += weight;
            for (size_t k = 0; k < CM_TEXEL; k++)
            {
                sum[k] += weight * (double)texel[k];
            }
        }
    }
    float *to = cm_level_texel(job->to, face, (ptrdiff_t)row, (ptrdiff_t)column);
    for (size_t k = 0; k < CM_TEXEL; k++)
    {
        to[k] = (float)(sum[k] / whole);
    }
    return whole;
}

static void halve_row(size_t index, void *user)
{
    const halve_job *job = user;
    const uint32_t n = job->to->size;
    const size_t face = index / n;
    const size_t row = index % n;
    const int has_angles = face < cm_angle_faces(job->environment->mapping);
    for (size_t column = 0; column < n; column++)
    {
        const double whole = mean_texel(job, face, row, column);
        if (has_angles)
        {
            job->to->angle[(face * n + row) * n + column] = whole;
        }
    }
}

/* ---- all of it ---- */

static int make_level(cm_environment *environment, uint32_t size)
{
    cm_level *level = &environment->level[environment->level_count];
    const size_t wide = (size_t)size + 2;
    const size_t faces = cm_angle_faces(environment->mapping);
    level->size = size;
    level->texels = cm_array_of(wide * wide, 6 * CM_TEXEL * sizeof *level->texels);
    level->angle = cm_array_of((size_t)size * size, faces * sizeof *level->angle);
    environment->level_count++;
    return level->texels != NULL && level->angle != NULL;
}

static cm_status make_levels(cm_environment *environment, uint32_t size)
{
    for (uint32_t n = size;; n = (n + 1) / 2)
    {
        if (!make_level(environment, n))
        {
            return CM_ERROR_MEMORY;
        }
        if (n == 1)
        {
            return CM_OK;
        }
    }
}

static cm_status fill(cm_environment *environment, const cm_image *faces, unsigned threads)
{
    const cm_level *finest = &environment->level[0];
    for (uint8_t face = 0; face < cm_angle_faces(environment->mapping); face++)
    {
        const cm_status status =
            cm_face_angles(environment->mapping, face, finest->size, threads,
                           finest->angle + (size_t)face * finest->size * finest->size);
        if (status != CM_OK)
        {
            return status;
        }
    }
    load_job load = {environment, faces};
    cm_run_pieces(threads, 6 * (size_t)finest->size, load_row, &load);
    cm_level_fill_border(environment->mapping, finest);
    for (uint32_t k = 1; k < environment->level_count; k++)
    {
        halve_job halve = {environment, &environment->level[k - 1], &environment->level[k]};
        cm_run_pieces(threads, 6 * (size_t)halve.to->size, halve_row, &halve);
        cm_level_fill_border(environment->mapping, halve.to);
    }
    return cm_angle_edges_make(environment->mapping, finest->size, threads, &environment->edge);
}

cm_status cm_environment_create(const cm_mapping *mapping, const cm_image faces[6],
                                unsigned threads, cm_environment **environment)
{
    if (environment == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_faces_check(mapping, faces);
    if (status != CM_OK)
    {
        return status;
    }
    cm_environment *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->mapping = mapping;
    made->channels = faces[0].channels;
    status = make_levels(made, faces[0].width);
    status = status == CM_OK ? fill(made, faces, threads) : status;
    if (status != CM_OK)
    {
        cm_environment_destroy(made);
        return status;
    }
    *environment = made;
    return CM_OK;
}
