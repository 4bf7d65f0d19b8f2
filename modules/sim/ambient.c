/* SPDX-License-Identifier: MIT
 *
 * Light from all around that surfaces scatter: rays go to where the surface scatters to, up to half of them to where the
 * picture is brighter than in the mean, and each counts by the power heuristic (Veach and Guibas 1995). What is everywhere
 * is seen by the first ones alone, which are even there.
 */
#include "low_discrepancy.h"
#include "sky.h"
#include "surface_ray.h"

#include <cubemap/random.h>

#include <math.h>
#include <stdlib.h>

enum
{
    BLOCK = 256,
    RAYS = 64,
    NUMBERS = 2,    /* block of the random generator */
    SKY_NUMBERS = 3 /* the same, of rays to the sky */
};

typedef struct ambient_rays
{
    size_t n;
    double origin[3][BLOCK];
    double direction[3][BLOCK];
    double far[BLOCK];
    double scattered[BLOCK]; /* BRDF times cosine */
    double density[BLOCK];   /* of the BRDF's directions */
    double even[BLOCK];      /* how much what is everywhere counts; 0 of rays to the sky */
    uint8_t blocked[BLOCK];
} ambient_rays;

/* A place, and how it is looked from. */
typedef struct ambient_place
{
    const tof_instant *instant;
    const tof_sky *sky;
    const cm_brdf *brdf;
    double normal[3];
    double out[3];
    double from[3];
    uint32_t by_surface, by_sky; /* rays */
} ambient_place;

/* What the picture's light counts by a ray: densities times rays, squared, say which of both ways is better here. */
static double part_of_picture(const ambient_place *at, double scattered, double by_surface,
                              double by_sky, int is_to_sky)
{
    const double surface = at->by_surface * by_surface, sky = at->by_sky * by_sky;
    const double both = surface * surface + sky * sky;
    return both > 0.0 ? scattered * (is_to_sky ? sky : surface) / both : 0.0;
}

static double sum_of_seen(const ambient_place *at, ambient_rays *r)
{
    const double *const origin[3] = {r->origin[0], r->origin[1], r->origin[2]};
    const double *const direction[3] = {r->direction[0], r->direction[1], r->direction[2]};
    double sum = 0.0;
    tof_cast_shadows(at->instant, r->n, origin, direction, r->far, r->blocked);
    for (size_t i = 0; i < r->n; i++)
    {
        const double d[3] = {r->direction[0][i], r->direction[1][i], r->direction[2][i]};
        double by_sky;
        const double shown = r->blocked[i] ? 0.0 : sky_look(at->sky, d, &by_sky);
        if (!r->blocked[i])
        {
            sum += r->even[i] * sky_constant(at->sky);
        }
        if (shown > 0.0)
        {
            sum += shown *
                   part_of_picture(at, r->scattered[i], r->density[i], by_sky, r->even[i] == 0.0);
        }
    }
    r->n = 0;
    return sum;
}

/* A ray in the direction; returns what is seen if the block is full. */
static double add_ray(const ambient_place *at, const double in[3], double scattered, double density,
                      double even, ambient_rays *r)
{
    for (int k = 0; k < 3; k++)
    {
        r->origin[k][r->n] = at->from[k];
        r->direction[k][r->n] = in[k];
    }
    r->far[r->n] = INFINITY;
    r->scattered[r->n] = scattered;
    r->density[r->n] = density;
    r->even[r->n++] = even;
    return r->n == BLOCK ? sum_of_seen(at, r) : 0.0;
}

static double look_along_surface(const ambient_place *at, const uint32_t words[4], ambient_rays *r)
{
    double sum = 0.0;
    for (uint32_t j = 0; j < at->by_surface; j++)
    {
        double u[3], in[3], density;
        low_discrepancy_point(words, j, u);
        const double part =
            cm_brdf_sample_direction(at->brdf, at->normal, at->out, u, in, &density);
        if (part > 0.0)
        {
            sum += add_ray(at, in, part * density, density, part / at->by_surface, r);
        }
    }
    return sum;
}

static double look_to_sky(const ambient_place *at, const uint32_t words[4], ambient_rays *r)
{
    double sum = 0.0;
    for (uint32_t j = 0; j < at->by_sky; j++)
    {
        double u[3], in[3];
        low_discrepancy_point(words, j, u);
        if (!sky_draw(at->sky, u, in))
        {
            continue;
        }
        const double cosine = in[0] * at->normal[0] + in[1] * at->normal[1] + in[2] * at->normal[2];
        const double scattered =
            cosine > 0.0 ? cosine * cm_brdf_value(at->brdf, at->normal, in, at->out) : 0.0;
        if (scattered > 0.0)
        {
            sum += add_ray(at, in, scattered, cm_brdf_density(at->brdf, at->normal, in, at->out),
                           0.0, r);
        }
    }
    return sum;
}

cm_status tof_environment_add(const tof_instant *instant, const tof_sky *sky,
                              const cm_tof_options *options, const tof_points *points,
                              tof_radiance *radiance)
{
    const uint32_t rays = options->paths != 0 ? options->paths : RAYS;
    ambient_place at = {.instant = instant, .sky = sky};
    ambient_rays *const r = malloc(sizeof *r);
    if (r == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    at.by_sky = (uint32_t)fmin(rays / 2, ceil(rays * sky_contrast(sky)));
    at.by_surface = rays - at.by_sky;
    r->n = 0;
    for (size_t point = 0; point < points->n; point++)
    {
        const tof_surface *s = tof_instant_surfaces(instant) + points->id[point];
        uint32_t words[4], sky_words[4];
        double place[3];
        for (int k = 0; k < 3; k++)
        {
            place[k] = points->position[k][point];
            at.normal[k] = points->normal[k][point];
            at.out[k] = points->to_camera[k][point];
        }
        at.brdf = s->brdf;
        leave_surface(place, at.normal, at.from);
        cm_random_block(options->seed, options->view, points->number[point], 0, NUMBERS, words);
        cm_random_block(options->seed, options->view, points->number[point], 0, SKY_NUMBERS,
                        sky_words);
        double sum = look_along_surface(&at, words, r);
        sum += look_to_sky(&at, sky_words, r);
        sum += sum_of_seen(&at, r);
        radiance->ambient[point] += sum * s->reflectance;
    }
    free(r);
    return CM_OK;
}
