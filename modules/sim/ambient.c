/* SPDX-License-Identifier: MIT
 *
 * Light from all around: what is shown of it, and what surfaces scatter of what they see of it.
 */
#include "low_discrepancy.h"
#include "surface_ray.h"

#include <cubemap/random.h>

#include <math.h>
#include <stdlib.h>

enum
{
    BLOCK = 256,
    RAYS = 64,
    NUMBERS = 2 /* block of the random generator */
};

double tof_environment_radiance(const cm_tof_environment *environment, const double direction[3])
{
    if (environment->radiance == NULL)
    {
        return environment->constant;
    }
    double uv[2];
    const uint8_t face = cm_forward(environment->mapping, direction, uv);
    if (face == CM_NO_FACE)
    {
        return environment->constant;
    }
    const uint32_t edge = environment->edge;
    const double column = fmax(0.0, 0.5 * (uv[0] + 1.0) * edge);
    const double row = fmax(0.0, 0.5 * (uv[1] + 1.0) * edge);
    const size_t i = column < edge ? (size_t)column : edge - 1;
    const size_t j = row < edge ? (size_t)row : edge - 1;
    return environment->constant +
           (double)environment->radiance[(face * (size_t)edge + j) * edge + i];
}

typedef struct ambient_rays
{
    size_t n;
    double origin[3][BLOCK];
    double direction[3][BLOCK];
    double far[BLOCK];
    double part[BLOCK];
    uint8_t blocked[BLOCK];
} ambient_rays;

static double sum_of_seen(const tof_instant *instant, const cm_tof_environment *environment,
                          ambient_rays *r)
{
    const double *const origin[3] = {r->origin[0], r->origin[1], r->origin[2]};
    const double *const direction[3] = {r->direction[0], r->direction[1], r->direction[2]};
    double sum = 0.0;
    tof_cast_shadows(instant, r->n, origin, direction, r->far, r->blocked);
    for (size_t i = 0; i < r->n; i++)
    {
        const double d[3] = {r->direction[0][i], r->direction[1][i], r->direction[2][i]};
        sum += r->blocked[i] ? 0.0 : r->part[i] * tof_environment_radiance(environment, d);
    }
    r->n = 0;
    return sum;
}

static double ambient_of_point(const tof_instant *instant, const cm_tof_environment *environment,
                               const cm_tof_options *options, const tof_points *points,
                               size_t point, ambient_rays *r)
{
    const tof_surface *s = tof_instant_surfaces(instant) + points->id[point];
    const uint32_t rays = options->paths != 0 ? options->paths : RAYS;
    double at[3];
    double normal[3];
    double out[3];
    double from[3];
    uint32_t words[4];
    double sum = 0.0;
    for (int k = 0; k < 3; k++)
    {
        at[k] = points->position[k][point];
        normal[k] = points->normal[k][point];
        out[k] = points->to_camera[k][point];
    }
    leave_surface(at, normal, from);
    cm_random_block(options->seed, options->view, points->number[point], 0, NUMBERS, words);
    for (uint32_t j = 0; j < rays; j++)
    {
        double u[3];
        double in[3];
        double density;
        low_discrepancy_point(words, j, u);
        const double part = cm_brdf_sample_direction(s->brdf, normal, out, u, in, &density);
        if (part > 0.0)
        {
            for (int k = 0; k < 3; k++)
            {
                r->origin[k][r->n] = from[k];
                r->direction[k][r->n] = in[k];
            }
            r->far[r->n] = INFINITY;
            r->part[r->n++] = part;
        }
        if (r->n == BLOCK)
        {
            sum += sum_of_seen(instant, environment, r);
        }
    }
    sum += sum_of_seen(instant, environment, r);
    return sum * s->reflectance / rays;
}

cm_status tof_environment_add(const tof_instant *instant, const cm_tof_environment *environment,
                              const cm_tof_options *options, const tof_points *points,
                              tof_radiance *radiance)
{
    ambient_rays *const r = malloc(sizeof *r);
    if (r == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    r->n = 0;
    for (size_t point = 0; point < points->n; point++)
    {
        radiance->ambient[point] +=
            ambient_of_point(instant, environment, options, points, point, r);
    }
    free(r);
    return CM_OK;
}
