/* SPDX-License-Identifier: MIT
 *
 * Light scattered several times, by paths from the camera: what virtual lights are judged by. Each place of a path sees all
 * lamps, or their shadows.
 */
#include "low_discrepancy.h"
#include "surface_ray.h"

#include <cubemap/random.h>

#include <math.h>
#include <stdlib.h>

enum
{
    BLOCK = 1024,
    /* Caches take arrays that are a power of two apart for one place. */
    ROOM = BLOCK + 40,
    NUMBERS = 1 /* block of the random generator */
};

/* Paths that are followed together: where each is, and what of the light from there comes to the camera. */
typedef struct path_block
{
    size_t n;
    size_t point[ROOM];
    uint32_t index[ROOM]; /* of the path among the point's */
    double at[3][ROOM];
    double normal[3][ROOM];
    double out[3][ROOM]; /* to where the path came from */
    uint32_t id[ROOM];
    double part[ROOM];
    double length[ROOM]; /* metres to the camera */
    double origin[3][ROOM];
    double direction[3][ROOM];
    double distance[ROOM];
    double light[ROOM]; /* radiance, if the lamp is seen */
    double to_lamp[ROOM];
    uint8_t blocked[ROOM];
} path_block;

typedef struct path_job
{
    const tof_instant *instant;
    const tof_lamp *lamp;
    size_t lamps;
    const cm_tof_options *options;
    const tof_waves *waves;
    const tof_points *points;
    tof_radiance *radiance;
    uint32_t paths;
} path_job;

static void vector_at(double (*const from)[ROOM], size_t i, double to[3])
{
    for (int k = 0; k < 3; k++)
    {
        to[k] = from[k][i];
    }
}

static void set_vector(double (*const to)[ROOM], size_t i, const double from[3])
{
    for (int k = 0; k < 3; k++)
    {
        to[k][i] = from[k];
    }
}

/* count paths of one point, from one on. */
static void begin_paths(const path_job *job, size_t point, uint32_t first, uint32_t count,
                        path_block *b)
{
    const tof_points *points = job->points;
    for (uint32_t j = 0; j < count; j++)
    {
        const size_t i = b->n++;
        for (int k = 0; k < 3; k++)
        {
            b->at[k][i] = points->position[k][point];
            b->normal[k][i] = points->normal[k][point];
            b->out[k][i] = points->to_camera[k][point];
        }
        b->point[i] = point;
        b->index[i] = first + j;
        b->id[i] = points->id[point];
        b->part[i] = 1.0 / job->paths;
        b->length[i] = points->range[point];
    }
}

/* Directions by BRDFs; paths that end are left out. */
static void scatter(const path_job *job, uint32_t bounce, path_block *b)
{
    const tof_surface *surface = tof_instant_surfaces(job->instant);
    size_t kept = 0;
    size_t point = SIZE_MAX;
    uint32_t words[4];
    for (size_t i = 0; i < b->n; i++)
    {
        double at[3];
        double normal[3];
        double out[3];
        double in[3];
        double from[3];
        double u[3];
        double density;
        if (b->point[i] != point)
        {
            point = b->point[i];
            cm_random_block(job->options->seed, job->options->view, job->points->number[point],
                            bounce, NUMBERS, words);
        }
        vector_at(b->at, i, at);
        vector_at(b->normal, i, normal);
        vector_at(b->out, i, out);
        low_discrepancy_point(words, b->index[i], u);
        const tof_surface *s = surface + b->id[i];
        const double part = b->part[i] * s->reflectance *
                            cm_brdf_sample_direction(s->brdf, normal, out, u, in, &density);
        if (!(part > 0.0))
        {
            continue;
        }
        leave_surface(at, normal, from);
        set_vector(b->origin, kept, from);
        set_vector(b->direction, kept, in);
        b->point[kept] = point;
        b->index[kept] = b->index[i];
        b->length[kept] = b->length[i];
        b->part[kept++] = part;
    }
    b->n = kept;
}

/* To the next surface; paths that find none are left out. */
static void go_on(const path_job *job, path_block *b)
{
    const double *const origin[3] = {b->origin[0], b->origin[1], b->origin[2]};
    const double *const direction[3] = {b->direction[0], b->direction[1], b->direction[2]};
    const tof_hits hits = {
        .distance = b->distance, .id = b->id, .normal = {b->normal[0], b->normal[1], b->normal[2]}};
    size_t kept = 0;
    tof_cast(job->instant, b->n, origin, direction, &hits);
    for (size_t i = 0; i < b->n; i++)
    {
        if (b->id[i] == CM_SCENE_NOTHING)
        {
            continue;
        }
        for (int k = 0; k < 3; k++)
        {
            b->at[k][kept] = b->origin[k][i] + b->distance[i] * b->direction[k][i];
            b->out[k][kept] = -b->direction[k][i];
            b->normal[k][kept] = b->normal[k][i];
        }
        b->point[kept] = b->point[i];
        b->index[kept] = b->index[i];
        b->id[kept] = b->id[i];
        b->part[kept] = b->part[i];
        b->length[kept++] = b->length[i] + b->distance[i];
    }
    b->n = kept;
}

/* What the lamp's light would be that is scattered here towards where the path came from. */
static void face_lamp(const path_job *job, const tof_lamp *lamp, path_block *b)
{
    const tof_surface *surface = tof_instant_surfaces(job->instant);
    for (size_t i = 0; i < b->n; i++)
    {
        double at[3];
        double normal[3];
        double out[3];
        double from[3];
        lamp_ray ray;
        vector_at(b->at, i, at);
        vector_at(b->normal, i, normal);
        vector_at(b->out, i, out);
        leave_surface(at, normal, from);
        const tof_surface *s = surface + b->id[i];
        const double irradiance = find_lamp_ray(lamp, at, normal, &ray);
        b->light[i] = irradiance == 0.0 ? 0.0
                                        : b->part[i] * s->reflectance * irradiance *
                                              cm_brdf_value(s->brdf, normal, ray.direction, out);
        b->to_lamp[i] = ray.distance;
        set_vector(b->origin, i, from);
        set_vector(b->direction, i, ray.direction);
    }
}

static void add_lamp(const path_job *job, path_block *b)
{
    const double *const origin[3] = {b->origin[0], b->origin[1], b->origin[2]};
    const double *const direction[3] = {b->direction[0], b->direction[1], b->direction[2]};
    const tof_radiance *to = job->radiance;
    tof_cast_shadows(job->instant, b->n, origin, direction, b->to_lamp, b->blocked);
    for (size_t i = 0; i < b->n; i++)
    {
        if (b->blocked[i] || b->light[i] == 0.0)
        {
            continue;
        }
        const size_t point = b->point[i];
        to->total[point] += b->light[i];
        for (size_t j = 0; j < job->waves->count; j++)
        {
            const double phase = job->waves->number[j] * (b->length[i] + b->to_lamp[i]);
            to->real[j * job->points->n + point] += b->light[i] * cos(phase);
            to->imaginary[j * job->points->n + point] += b->light[i] * sin(phase);
        }
    }
}

static void follow(const path_job *job, path_block *b)
{
    for (int bounce = 0; bounce < job->options->bounces && b->n > 0; bounce++)
    {
        scatter(job, (uint32_t)bounce, b);
        go_on(job, b);
        for (size_t lamp = 0; lamp < job->lamps; lamp++)
        {
            face_lamp(job, job->lamp + lamp, b);
            add_lamp(job, b);
        }
    }
    b->n = 0;
}

cm_status tof_paths_add(const tof_instant *instant, const tof_lamp *lamp, size_t lamps,
                        const cm_tof_options *options, const tof_waves *waves,
                        const tof_points *points, tof_radiance *radiance)
{
    const path_job job = {
        instant, lamp,   lamps,    options,
        waves,   points, radiance, options->paths != 0 ? options->paths : TOF_PATHS};
    path_block *const b = malloc(sizeof *b);
    if (b == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    b->n = 0;
    for (size_t point = 0; point < points->n; point++)
    {
        /* Blocks begin where points do, so that sums have one order whatever is in the call. */
        if (b->n + job.paths > BLOCK)
        {
            follow(&job, b);
        }
        for (uint32_t first = 0; first < job.paths; first += BLOCK)
        {
            const uint32_t left = job.paths - first;
            begin_paths(&job, point, first, left < BLOCK ? left : BLOCK, b);
            if (left > BLOCK)
            {
                follow(&job, b);
            }
        }
    }
    follow(&job, b);
    free(b);
    return CM_OK;
}
