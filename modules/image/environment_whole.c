/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "environment_whole.h"

#include <math.h>
#include <stdlib.h>

#include "environment_angles.h"
#include "environment_levels.h"
#include "environment_lookup.h"
#include "environment_pixels.h"
#include "image_jobs.h"

#define PI 3.14159265358979323846

/* So many points are weighed at once, and sums of them added up. */
#define SOME 256

/* The environment as points with solid angles, in separate arrays; behind the last there are some without any. */
typedef struct points
{
    size_t count; /* a multiple of SOME */
    double *x;
    double *y;
    double *z;
    double *angle;
    double *value[CM_TEXEL]; /* times the solid angle */
    double *memory;          /* of all these; to be freed */
} points;

typedef struct whole_job
{
    const cm_environment *environment;
    const cm_level *level;
    uint32_t subdivision;
    points points;
    double alpha_squared;
    double unit; /* GGX: weights are brought to about 1 by it */
    const cm_mapping *mapping;
    const cm_image *to;
} whole_job;

/* ---- points ---- */

static cm_status allocate_points(size_t count, points *p)
{
    p->count = (count + SOME - 1) / SOME * SOME;
    p->memory = cm_array_of(p->count, 8 * sizeof *p->memory);
    if (p->memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    p->x = p->memory;
    p->y = p->x + p->count;
    p->z = p->y + p->count;
    p->angle = p->z + p->count;
    for (size_t c = 0; c < CM_TEXEL; c++)
    {
        p->value[c] = p->angle + (c + 1) * p->count;
    }
    for (size_t i = count; i < p->count; i++)
    {
        p->x[i] = p->y[i] = p->angle[i] = 0.0;
        p->z[i] = 1.0;
        for (size_t c = 0; c < CM_TEXEL; c++)
        {
            p->value[c][i] = 0.0;
        }
    }
    return CM_OK;
}

/* A row of points; rows of all faces are counted through. angle has theirs already. */
static void fill_row(size_t index, void *user)
{
    const whole_job *job = user;
    const points *p = &job->points;
    const size_t n = (size_t)job->level->size * job->subdivision;
    const uint8_t face = (uint8_t)(index / n);
    const double v = (2.0 * (double)(index % n) + 1.0) / (double)n - 1.0;
    for (size_t i = 0; i < n; i++)
    {
        const size_t at = index * n + i;
        const double u = (2.0 * (double)i + 1.0) / (double)n - 1.0;
        float value[CM_TEXEL] = {0.0F, 0.0F, 0.0F, 0.0F};
        double direction[3];
        cm_inverse(job->environment->mapping, face, (const double[2]){u, v}, direction);
        cm_level_add(job->level, face, (float)u, (float)v, 1.0F, value);
        p->x[at] = direction[0];
        p->y[at] = direction[1];
        p->z[at] = direction[2];
        for (size_t c = 0; c < CM_TEXEL; c++)
        {
            p->value[c][at] = p->angle[at] * (double)value[c];
        }
    }
}

static cm_status make_points(whole_job *job, unsigned threads)
{
    const cm_environment *environment = job->environment;
    const size_t n = (size_t)job->level->size * job->subdivision;
    cm_status status = allocate_points(6 * n * n, &job->points);
    for (uint8_t face = 0; face < 6 && status == CM_OK; face++)
    {
        double *angle = job->points.angle;
        if (face < cm_angle_faces(environment->mapping))
        {
            status = cm_face_angles(environment->mapping, face, (uint32_t)n, threads,
                                    angle + face * n * n);
            continue;
        }
        for (size_t i = 0; i < n * n; i++)
        {
            angle[face * n * n + i] = angle[i];
        }
    }
    if (status == CM_OK)
    {
        cm_run_pieces(threads, 6 * n, fill_row, job);
    }
    return status;
}

/* ---- sums ---- */

static void weigh(const whole_job *job, const double direction[3], size_t first,
                  double weight[SOME])
{
    const double *x = job->points.x + first;
    const double *y = job->points.y + first;
    const double *z = job->points.z + first;
    const double a = job->alpha_squared;
    if (a < 0.0)
    {
        for (size_t i = 0; i < SOME; i++)
        {
            const double cosine = direction[0] * x[i] + direction[1] * y[i] + direction[2] * z[i];
            weight[i] = cosine > 0.0 ? cosine : 0.0;
        }
        return;
    }
    for (size_t i = 0; i < SOME; i++)
    {
        const double dx = direction[0] - x[i];
        const double dy = direction[1] - y[i];
        const double dz = direction[2] - z[i];
        const double s = 0.25 * (dx * dx + dy * dy + dz * dz);
        const double share = job->unit / (a + (1.0 - a) * s);
        const double cosine = 1.0 - 2.0 * s;
        weight[i] = cosine > 0.0 ? cosine * share * share : 0.0;
    }
}

/* Four sums side by side, so that they go into vectors without being reordered. */
static double dot(const double *restrict a, const double *restrict b)
{
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    for (size_t i = 0; i < SOME; i += 4)
    {
        for (size_t k = 0; k < 4; k++)
        {
            sum[k] += a[i + k] * b[i + k];
        }
    }
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/* A row of the target; rows of all faces are counted through. */
static void weigh_row(size_t index, void *user)
{
    const whole_job *job = user;
    const points *p = &job->points;
    const uint32_t n = job->to[0].width;
    const uint8_t face = (uint8_t)(index / n);
    const uint32_t row = (uint32_t)(index % n);
    const double scale = job->alpha_squared < 0.0 ? PI : 1.0;
    double weight[SOME];
    for (uint32_t column = 0; column < n; column++)
    {
        double direction[3];
        const double uv[2] = {(2.0 * column + 1.0) / n - 1.0, (2.0 * row + 1.0) / n - 1.0};
        cm_inverse(job->mapping, face, uv, direction);
        double whole = 0.0;
        double sum[CM_TEXEL] = {0.0, 0.0, 0.0, 0.0};
        for (size_t first = 0; first < p->count; first += SOME)
        {
            weigh(job, direction, first, weight);
            whole += dot(weight, p->angle + first);
            for (uint32_t c = 0; c < job->to[0].channels; c++)
            {
                sum[c] += dot(weight, p->value[c] + first);
            }
        }
        float value[CM_TEXEL];
        for (size_t c = 0; c < CM_TEXEL; c++)
        {
            value[c] = (float)(scale * sum[c] / whole);
        }
        cm_pixel_store(&job->to[face], cm_face_row(job->mapping, n, row), column, value);
    }
}

cm_status cm_environment_whole(const cm_environment *environment, double alpha_squared,
                               uint32_t level, uint32_t subdivision, const cm_mapping *mapping,
                               unsigned threads, const cm_image to[6])
{
    const double n = (double)environment->level[level].size * subdivision;
    whole_job job = {
        environment, &environment->level[level], subdivision, {0}, alpha_squared, 0.0, mapping, to};
    /* s of the nearest point is about that at most, so that not all weights are too small for numbers */
    job.unit = fmax(alpha_squared, 0.25 / (n * n));
    const cm_status status = make_points(&job, threads);
    if (status == CM_OK)
    {
        cm_run_pieces(threads, 6 * (size_t)to[0].width, weigh_row, &job);
    }
    free(job.points.memory);
    return status;
}
