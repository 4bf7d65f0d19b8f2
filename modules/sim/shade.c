/* SPDX-License-Identifier: MIT */
#include "shade.h"

#include <math.h>
#include <string.h>

#define PER_PI 0.31830988618379067154

/* The points at which rays of a block end. */
typedef struct ray_ends
{
    double position[3][TOF_BLOCK];
    double leg[TOF_BLOCK]; /* to the camera; 1 where nothing is */
    double
        strength[TOF_BLOCK]; /* BRDF towards the camera of Lambert's surfaces; 0 where nothing is */
} ray_ends;

#define COLUMNS_OF(array)                                                                          \
    {                                                                                              \
        (array)[0], (array)[1], (array)[2]                                                         \
    }

static size_t room_of(size_t n)
{
    return (n + TOF_ROOM - 1) / TOF_ROOM * TOF_ROOM;
}

/* Of the camera's places; whole vectors end with more of the last one. Marks those that have no ray; returns 0 if all have. */
static int make_rays(const tof_scenery *scenery, size_t n, const double *column, const double *row,
                     tof_light_block *light, uint8_t *has_ray)
{
    _Alignas(64) double x[TOF_BLOCK], y[TOF_BLOCK], z[TOF_BLOCK];
    cm_camera_ray_array(scenery->sensor->given.camera, n, column, row, x, y, z);
    for (size_t i = n; i < room_of(n); i++)
    {
        x[i] = x[n - 1];
        y[i] = y[n - 1];
        z[i] = z[n - 1];
    }
    light->rays.has_apex = 1;
    memcpy(light->rays.apex, scenery->camera.position, sizeof light->rays.apex);
    const int some_are_none = scenery->set->aim(n, scenery->camera.rotation.row, x, y, z,
                                                light->rays.direction, light->lens);
    for (size_t i = 0; some_are_none && i < n; i++)
    {
        has_ray[i] = x[i] + y[i] + z[i] < INFINITY; /* not NaN */
    }
    for (size_t i = 0; !scenery->sensor->has_axis && i < n; i++)
    {
        light->lens[i] = 1.0;
    }
    return some_are_none;
}

/* What rays meet, and how Lambert's surfaces scatter there; places without a ray meet nothing. */
static void meet_surfaces(const tof_scenery *scenery, size_t n, const uint8_t *has_ray,
                          tof_light_block *light, ray_ends *ends)
{
    const tof_surface *surface = tof_instant_surfaces(scenery->instant);
    uint32_t triangle[TOF_BLOCK];
    for (size_t i = 0; i < room_of(n); i++)
    {
        light->rays.distance[i] = INFINITY;
    }
    tof_meet(scenery->instant, n, &light->rays, triangle);
    for (size_t i = 0; has_ray != NULL && i < n; i++)
    {
        light->rays.distance[i] = has_ray[i] ? light->rays.distance[i] : INFINITY;
        light->rays.number[i] = has_ray[i] ? light->rays.number[i] : -1.0;
    }
    scenery->set->reach(n, &light->rays, ends->position, ends->leg);
    for (size_t i = 0; i < n; i++)
    {
        const int64_t number = (int64_t)light->rays.number[i];
        light->id[i] = (uint32_t)number; /* of -1 nothing */
        ends->strength[i] = number < 0 ? 0.0 : surface[number].reflectance * PER_PI;
    }
    for (size_t i = n; i < room_of(n); i++)
    {
        ends->strength[i] = 0.0;
    }
}

/* What is between the lamp and the places: those that lie in shadow lose their strength. */
static void cast_shadows(const tof_scenery *scenery, size_t lamp, size_t n, const ray_ends *ends,
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
            direction[k][i] = ends->position[k][i] - from[k];
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
static void weigh(const tof_scenery *scenery, const tof_lamp *lamp, size_t n, const ray_ends *ends,
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
            in[k] = lamp->position[k] - ends->position[k][i];
            out[k] = -light->rays.direction[k][i];
            normal[k] = light->rays.normal[k][i];
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

static void shine(const tof_scenery *scenery, size_t n, const ray_ends *ends,
                  tof_light_block *light)
{
    _Alignas(64) double strength[TOF_BLOCK];
    tof_lit lit = {.position = COLUMNS_OF(ends->position),
                   .normal = COLUMNS_OF(light->rays.normal),
                   .range = ends->leg,
                   .total = light->total,
                   .real = light->real[0],
                   .imaginary = light->imaginary[0],
                   .stride = TOF_BLOCK};
    memset(light->shadows, 0, n * sizeof *light->shadows);
    for (size_t j = 0; j < scenery->lamps; j++)
    {
        const tof_lamp *lamp = &scenery->lamp[j];
        const int is_beside = lamp_is_beside(lamp, scenery->camera.position);
        const int is_weighed = lamp->n > 0 || scenery->instant->has_brdf;
        if (is_beside || is_weighed)
        {
            memcpy(strength, ends->strength, room_of(n) * sizeof *strength);
        }
        if (is_beside)
        {
            cast_shadows(scenery, j, n, ends, light, strength);
        }
        if (is_weighed)
        {
            weigh(scenery, lamp, n, ends, light, strength);
        }
        lit.strength = is_beside || is_weighed ? strength : ends->strength;
        lit.is_first = j == 0;
        scenery->set->light(lamp, &scenery->waves, n, &lit);
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

static void find_places(size_t n, const ray_ends *ends, const uint32_t *number,
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
            found->position[k][to] = ends->position[k][i];
            found->normal[k][to] = light->rays.normal[k][i];
            found->out[k][to] = -light->rays.direction[k][i];
        }
        found->range[to] = light->rays.distance[i];
        found->id[to] = light->id[i];
        found->number[to] = number[i];
        found->of[to] = i;
    }
}

/* Scattered light and that of the surroundings, of the places that there are. */
static cm_status scatter(const tof_scenery *scenery, size_t n, const ray_ends *ends,
                         const uint32_t *number, tof_light_block *light)
{
    const cm_tof_options *options = scenery->options;
    double total[TOF_BLOCK] = {0}, ambient[TOF_BLOCK] = {0};
    double real[SENSOR_WAVES * TOF_BLOCK], imaginary[SENSOR_WAVES * TOF_BLOCK];
    places at;
    find_places(n, ends, number, light, &at);
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
        light->ambient[i] = ambient[k];
        for (size_t j = 0; j < scenery->waves.count; j++)
        {
            light->real[j][i] += real[j * count + k];
            light->imaginary[j][i] += imaginary[j * count + k];
        }
    }
    return status;
}

/* What is seen of the surroundings themselves. */
static void look_beyond(const tof_scenery *scenery, size_t n, const uint8_t *has_ray,
                        tof_light_block *light)
{
    for (size_t i = 0; i < n; i++)
    {
        if (light->id[i] == CM_SCENE_NOTHING && (has_ray == NULL || has_ray[i]))
        {
            const double direction[3] = {light->rays.direction[0][i], light->rays.direction[1][i],
                                         light->rays.direction[2][i]};
            light->ambient[i] = sky_radiance(scenery->options->environment, direction);
        }
    }
}

cm_status tof_shade(const tof_scenery *scenery, size_t n, const double *column, const double *row,
                    const uint32_t *number, tof_light_block *light)
{
    _Alignas(64) ray_ends ends;
    uint8_t marks[TOF_BLOCK];
    const cm_tof_options *options = scenery->options;
    const uint8_t *const has_ray = make_rays(scenery, n, column, row, light, marks) ? marks : NULL;
    meet_surfaces(scenery, n, has_ray, light, &ends);
    shine(scenery, n, &ends, light);
    cm_status status = CM_OK;
    if (options->environment != NULL)
    {
        memset(light->ambient, 0, n * sizeof *light->ambient);
    }
    if (options->bounces > 0 || options->environment != NULL)
    {
        memcpy(light->direct_real, light->real[0], n * sizeof *light->direct_real);
        memcpy(light->direct_imaginary, light->imaginary[0], n * sizeof *light->direct_imaginary);
        status = scatter(scenery, n, &ends, number, light);
    }
    if (options->environment != NULL)
    {
        look_beyond(scenery, n, has_ray, light);
    }
    return status;
}
