/* SPDX-License-Identifier: MIT */
#include "shade.h"

#include <math.h>
#include <string.h>

#define PER_PI 0.31830988618379067154

/* Rays of a block in the world, and the points at their ends. */
typedef struct ray_block
{
    double origin[3][TOF_BLOCK];
    double direction[3][TOF_BLOCK];
    double position[3][TOF_BLOCK];
    double leg[TOF_BLOCK];      /* to the camera; 1 where nothing is */
    double lens[TOF_BLOCK];     /* cos^4 of the angle from the optical axis; 1 without one */
    double strength[TOF_BLOCK]; /* BRDF towards the camera of Lambert's surfaces */
    uint8_t has_ray[TOF_BLOCK];
} ray_block;

#define COLUMNS_OF(array)                                                                          \
    {                                                                                              \
        (array)[0], (array)[1], (array)[2]                                                         \
    }

static size_t room_of(size_t n)
{
    return (n + TOF_ROOM - 1) / TOF_ROOM * TOF_ROOM;
}

static void make_rays(const tof_scenery *scenery, size_t n, const double *column, const double *row,
                      ray_block *rays)
{
    double x[TOF_BLOCK], y[TOF_BLOCK], z[TOF_BLOCK];
    const double(*const axes)[3] = scenery->camera.rotation.row;
    cm_camera_ray_array(scenery->sensor->given.camera, n, column, row, x, y, z);
    for (size_t i = 0; i < n; i++)
    {
        const int is_ray = x[i] + y[i] + z[i] < INFINITY; /* not NaN */
        x[i] = is_ray ? x[i] : 0.0;
        y[i] = is_ray ? y[i] : 0.0;
        z[i] = is_ray ? z[i] : 1.0;
        rays->has_ray[i] = (uint8_t)is_ray;
    }
    const double origin[3] = {scenery->camera.position[0], scenery->camera.position[1],
                              scenery->camera.position[2]};
    for (size_t i = n; i < room_of(n); i++)
    {
        x[i] = y[i] = z[i] = 1.0;
    }
    scenery->set->aim(n, axes, x, y, z, rays->direction, rays->lens);
    for (int k = 0; k < 3; k++)
    {
        for (size_t i = 0; i < n; i++)
        {
            rays->origin[k][i] = origin[k];
        }
    }
    for (size_t i = 0; !scenery->sensor->has_axis && i < n; i++)
    {
        rays->lens[i] = 1.0;
    }
}

/* Where rays end, and how Lambert's surfaces scatter; what is not there has strength 0 and stands in front of the camera. */
static void put_points(const tof_scenery *scenery, size_t n, ray_block *rays,
                       tof_light_block *light)
{
    const tof_surface *surface = tof_instant_surfaces(scenery->instant);
    for (size_t i = 0; i < n; i++)
    {
        light->range[i] = rays->has_ray[i] ? light->range[i] : INFINITY;
        light->id[i] = light->range[i] < INFINITY ? light->id[i] : CM_SCENE_NOTHING;
        const int is_there = light->id[i] != CM_SCENE_NOTHING;
        rays->leg[i] = is_there ? light->range[i] : 1.0;
        rays->strength[i] = is_there ? surface[light->id[i]].reflectance * PER_PI : 0.0;
        for (int k = 0; k < 3; k++)
        {
            rays->position[k][i] = rays->origin[k][i] + rays->leg[i] * rays->direction[k][i];
        }
    }
}

/* What is between the lamp and the places: those that lie in shadow lose their strength. */
static void cast_shadows(const tof_scenery *scenery, size_t lamp, size_t n, const ray_block *rays,
                         tof_light_block *light, double *strength)
{
    double origin[3][TOF_BLOCK], direction[3][TOF_BLOCK], far[TOF_BLOCK];
    uint8_t blocked[TOF_BLOCK];
    const double *from = scenery->lamp[lamp].position;
    for (size_t i = 0; i < n; i++)
    {
        double square = 0.0;
        for (int k = 0; k < 3; k++)
        {
            origin[k][i] = from[k];
            direction[k][i] = rays->position[k][i] - from[k];
            square += direction[k][i] * direction[k][i];
        }
        const double length = sqrt(square);
        for (int k = 0; k < 3; k++)
        {
            direction[k][i] = length > 0.0 ? direction[k][i] / length : (double)(k == 2);
        }
        far[i] = length * (1.0 - 1e-9);
    }
    const double *const origins[3] = COLUMNS_OF(origin);
    const double *const directions[3] = COLUMNS_OF(direction);
    tof_cast_shadows(scenery->instant, n, origins, directions, far, blocked);
    for (size_t i = 0; i < n; i++)
    {
        strength[i] = blocked[i] ? 0.0 : strength[i];
        light->shadows[i] |= blocked[i] ? UINT64_C(1) << lamp : 0;
    }
}

/* Of a table's lamp intensity by the even one's; of other surfaces their BRDF. */
static void weigh(const tof_scenery *scenery, const tof_lamp *lamp, size_t n, const ray_block *rays,
                  const tof_light_block *light, double *strength)
{
    const tof_surface *surface = tof_instant_surfaces(scenery->instant);
    for (size_t i = 0; i < n; i++)
    {
        if (strength[i] == 0.0)
        {
            continue;
        }
        const cm_brdf *brdf = surface[light->id[i]].brdf;
        if (lamp->n == 0 && brdf == NULL)
        {
            continue;
        }
        double in[3], out[3], normal[3], square = 0.0;
        for (int k = 0; k < 3; k++)
        {
            in[k] = lamp->position[k] - rays->position[k][i];
            out[k] = -rays->direction[k][i];
            normal[k] = light->normal[k][i];
            square += in[k] * in[k];
        }
        const double length = sqrt(square);
        double cosine = 0.0;
        for (int k = 0; k < 3; k++)
        {
            in[k] /= length;
            cosine -= in[k] * lamp->axis[k];
        }
        if (lamp->n > 0)
        {
            strength[i] *=
                lamp->intensity > 0.0 ? tof_lamp_intensity(lamp, cosine) / lamp->intensity : 0.0;
        }
        if (brdf != NULL)
        {
            strength[i] *= cm_brdf_value(brdf, normal, in, out) / PER_PI;
        }
    }
}

static void shine(const tof_scenery *scenery, size_t n, const ray_block *rays,
                  tof_light_block *light)
{
    double strength[TOF_BLOCK];
    const tof_lit lit = {.position = COLUMNS_OF(rays->position),
                         .normal = COLUMNS_OF(light->normal),
                         .range = rays->leg,
                         .strength = strength,
                         .total = light->total,
                         .real = light->real[0],
                         .imaginary = light->imaginary[0],
                         .stride = TOF_BLOCK};
    for (size_t j = 0; j < scenery->lamps; j++)
    {
        memcpy(strength, rays->strength, sizeof strength);
        if (lamp_is_beside(&scenery->lamp[j], scenery->camera.position))
        {
            cast_shadows(scenery, j, n, rays, light, strength);
        }
        weigh(scenery, &scenery->lamp[j], n, rays, light, strength);
        scenery->set->light(&scenery->lamp[j], &scenery->waves, n, &lit);
    }
}

/* Those of a block's places where something is. */
typedef struct places
{
    size_t count;
    size_t of[TOF_BLOCK]; /* in the block */
    double position[3][TOF_BLOCK], normal[3][TOF_BLOCK], out[3][TOF_BLOCK], range[TOF_BLOCK];
    uint32_t id[TOF_BLOCK], number[TOF_BLOCK];
} places;

static void find_places(size_t n, const ray_block *rays, const uint32_t *number,
                        const tof_light_block *light, places *found)
{
    found->count = 0;
    for (size_t i = 0; i < n; i++)
    {
        if (light->id[i] == CM_SCENE_NOTHING)
        {
            continue;
        }
        const size_t to = found->count++;
        for (int k = 0; k < 3; k++)
        {
            found->position[k][to] = rays->position[k][i];
            found->normal[k][to] = light->normal[k][i];
            found->out[k][to] = -rays->direction[k][i];
        }
        found->range[to] = light->range[i];
        found->id[to] = light->id[i];
        found->number[to] = number[i];
        found->of[to] = i;
    }
}

/* Scattered light and that of the surroundings, of the places that there are. */
static cm_status scatter(const tof_scenery *scenery, size_t n, const ray_block *rays,
                         const uint32_t *number, tof_light_block *light)
{
    const cm_tof_options *options = scenery->options;
    double total[TOF_BLOCK] = {0}, ambient[TOF_BLOCK] = {0};
    double real[SENSOR_WAVES * TOF_BLOCK], imaginary[SENSOR_WAVES * TOF_BLOCK];
    places at;
    find_places(n, rays, number, light, &at);
    const size_t count = at.count;
    memset(real, 0, sizeof *real * scenery->waves.count * count);
    memset(imaginary, 0, sizeof *imaginary * scenery->waves.count * count);
    const tof_points points = {count,
                               COLUMNS_OF(at.position),
                               COLUMNS_OF(at.normal),
                               COLUMNS_OF(at.out),
                               at.range,
                               at.id,
                               at.number};
    tof_radiance radiance = {total, real, imaginary, ambient};
    cm_status status = CM_OK;
    if (scenery->virtual_lights != NULL)
    {
        status = tof_virtual_lights_add(scenery->virtual_lights, &points, &radiance);
    }
    else if (options->bounces > 0)
    {
        status = tof_paths_add(scenery->instant, scenery->lamp, scenery->lamps, options,
                               &scenery->waves, &points, &radiance);
    }
    if (status == CM_OK && scenery->sky != NULL)
    {
        status = tof_environment_add(scenery->instant, scenery->sky, options, &points, &radiance);
    }
    for (size_t k = 0; k < count; k++)
    {
        const size_t i = at.of[k];
        light->total[i] += total[k];
        light->ambient[i] += ambient[k];
        for (size_t j = 0; j < scenery->waves.count; j++)
        {
            light->real[j][i] += real[j * count + k];
            light->imaginary[j][i] += imaginary[j * count + k];
        }
    }
    return status;
}

/* What is seen of the surroundings themselves. */
static void look_beyond(const tof_scenery *scenery, size_t n, const ray_block *rays,
                        tof_light_block *light)
{
    for (size_t i = 0; i < n; i++)
    {
        if (light->id[i] == CM_SCENE_NOTHING && rays->has_ray[i])
        {
            const double direction[3] = {rays->direction[0][i], rays->direction[1][i],
                                         rays->direction[2][i]};
            light->ambient[i] = sky_radiance(scenery->options->environment, direction);
        }
    }
}

/* Lambers, Hoberg and Kolb 2015, eq. 9. */
static void pass_lens(const tof_scenery *scenery, size_t n, const double *lens,
                      tof_light_block *light)
{
    for (size_t i = 0; i < n; i++)
    {
        light->total[i] *= lens[i];
        light->ambient[i] *= lens[i];
        light->direct_real[i] *= lens[i];
        light->direct_imaginary[i] *= lens[i];
    }
    for (size_t j = 0; j < scenery->waves.count; j++)
    {
        for (size_t i = 0; i < n; i++)
        {
            light->real[j][i] *= lens[i];
            light->imaginary[j][i] *= lens[i];
        }
    }
}

/* No light has come; what whole vectors have beyond n is dark. */
static void begin_light(size_t n, size_t waves, ray_block *rays, tof_light_block *light)
{
    for (size_t i = n; i < room_of(n); i++)
    {
        rays->strength[i] = 0.0;
        rays->leg[i] = 1.0;
        for (int k = 0; k < 3; k++)
        {
            rays->position[k][i] = rays->position[k][0];
            light->normal[k][i] = light->normal[k][0];
        }
    }
    memset(light->total, 0, sizeof light->total);
    memset(light->ambient, 0, sizeof light->ambient);
    memset(light->shadows, 0, sizeof light->shadows);
    for (size_t j = 0; j < waves; j++)
    {
        memset(light->real[j], 0, sizeof light->real[j]);
        memset(light->imaginary[j], 0, sizeof light->imaginary[j]);
    }
}

cm_status tof_shade(const tof_scenery *scenery, size_t n, const double *column, const double *row,
                    const uint32_t *number, tof_light_block *light)
{
    _Alignas(64) ray_block rays;
    const cm_tof_options *options = scenery->options;
    make_rays(scenery, n, column, row, &rays);
    const double *const origin[3] = COLUMNS_OF(rays.origin);
    const double *const direction[3] = COLUMNS_OF(rays.direction);
    const tof_hits hits = {light->range, light->id, NULL, COLUMNS_OF(light->normal)};
    tof_cast(scenery->instant, n, origin, direction, &hits);
    put_points(scenery, n, &rays, light);
    begin_light(n, scenery->waves.count, &rays, light);
    shine(scenery, n, &rays, light);
    memcpy(light->direct_real, light->real[0], sizeof light->direct_real);
    memcpy(light->direct_imaginary, light->imaginary[0], sizeof light->direct_imaginary);
    cm_status status = CM_OK;
    if (options->bounces > 0 || options->environment != NULL)
    {
        status = scatter(scenery, n, &rays, number, light);
    }
    if (options->environment != NULL)
    {
        look_beyond(scenery, n, &rays, light);
    }
    pass_lens(scenery, n, rays.lens, light);
    return status;
}
