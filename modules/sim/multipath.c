/* SPDX-License-Identifier: MIT
 *
 * Light once scattered: instant radiosity (Keller 1997) as Bulczak, Lambers and Kolb 2018 have it in section 3.3, but that
 * lights may cast shadows.
 */
#include "modules/memory/checked_size.h"
#include "multipath_object.h"
#include "brdf_object.h"

#include <cubemap/options.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    MAP_EDGE = 64,
    BLOCK = 512
};

/* ---- Making ---- */

/* Numbers of the loops: from the middle of the lights, in floats. */
static void make_fast(tof_virtual_lights *lights)
{
    for (uint32_t i = 0; i < lights->count; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            lights->origin[k] += lights->light[i].position[k] / lights->count;
        }
    }
    for (size_t j = 0; j < lights->waves.count; j++)
    {
        lights->per_metre[j] = (float)(lights->waves.number[j] / (2.0 * PI));
    }
    for (uint32_t i = 0; i < lights->count; i++)
    {
        const virtual_light *l = lights->light + i;
        gather_light *const f = lights->fast + i;
        for (int k = 0; k < 3; k++)
        {
            f->position[k] = (float)(l->position[k] - lights->origin[k]);
            f->normal[k] = (float)l->normal[k];
        }
        f->strength = (float)(l->flux / PI);
        f->most = (float)fmin(1e30, PI / l->area);
        for (size_t j = 0; j < lights->waves.count; j++)
        {
            const double turns = l->length * lights->waves.number[j] / (2.0 * PI);
            lights->begun[i * lights->waves.count + j] = (float)(turns - floor(turns));
        }
    }
}

/* Those that scatter by Lambert's law first, else in their order. */
static cm_status sort_lights(tof_virtual_lights *lights)
{
    const tof_surface *surface = tof_instant_surfaces(lights->instant);
    virtual_light *const sorted = cm_array_of(lights->count + (size_t)1, sizeof *sorted);
    if (sorted == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    uint32_t n = 0;
    for (int others = 0; others < 2; others++)
    {
        for (uint32_t i = 0; i < lights->count; i++)
        {
            if (brdf_is_lambert(surface[lights->light[i].id].brdf) == !others)
            {
                sorted[n++] = lights->light[i];
            }
        }
        lights->lambert = others ? lights->lambert : n;
    }
    free(lights->light);
    lights->light = sorted;
    return CM_OK;
}

/* Shadows need no cells of equal area, and each pair asks for one: a mapping that costs less. */
static cm_status choose_mappings(tof_virtual_lights *lights, const cm_tof_options *options)
{
    lights->mapping = lights->shadow_mapping = options->mapping;
    if (options->mapping != NULL)
    {
        return CM_OK;
    }
    cm_status status = cm_mapping_create("healpix", NULL, &lights->own);
    if (status == CM_OK && options->visibility)
    {
        status = cm_mapping_create("algebraic", NULL, &lights->own_of_shadows);
    }
    lights->mapping = lights->own;
    lights->shadow_mapping = lights->own_of_shadows;
    return status;
}

static cm_status make_lights(tof_virtual_lights *lights, const tof_lamp *lamp, size_t lamps,
                             const cm_tof_options *options, cm_pool *pool)
{
    const uint32_t count = options->lights != 0 ? options->lights : TOF_LIGHTS;
    const uint32_t edge = options->map_edge != 0 ? options->map_edge : MAP_EDGE;
    cm_status status = choose_mappings(lights, options);
    if (status != CM_OK)
    {
        return status;
    }
    lights->set = gather_set_find(cm_mapping_instructions(lights->mapping));
    lights->light = cm_array_of(count, sizeof *lights->light);
    lights->fast = cm_array_of(count, sizeof *lights->fast);
    lights->begun =
        cm_array_of(count, cm_size_product(lights->waves.count + 1, sizeof *lights->begun));
    if (lights->light == NULL || lights->fast == NULL || lights->begun == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    status = draw_virtual_lights(lights->instant, lights->mapping, edge, lamp, lamps, count, pool,
                                 lights->light, &lights->count);
    status = status != CM_OK ? status : sort_lights(lights);
    if (status != CM_OK)
    {
        return status;
    }
    make_fast(lights);
    return options->visibility && lights->count > 0 ? draw_shadows(lights, pool) : CM_OK;
}

cm_status tof_virtual_lights_create(const tof_instant *instant, const tof_lamp *lamp, size_t lamps,
                                    const cm_tof_options *options, const tof_waves *waves,
                                    cm_pool *pool, tof_virtual_lights **made)
{
    *made = NULL;
    tof_virtual_lights *const lights = calloc(1, sizeof *lights);
    if (lights == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    lights->instant = instant;
    lights->waves = *waves;
    const cm_status status = make_lights(lights, lamp, lamps, options, pool);
    if (status != CM_OK)
    {
        tof_virtual_lights_destroy(lights);
        return status;
    }
    *made = lights;
    return CM_OK;
}

void tof_virtual_lights_destroy(tof_virtual_lights *lights)
{
    if (lights != NULL)
    {
        cm_mapping_destroy(lights->own);
        cm_mapping_destroy(lights->own_of_shadows);
        free(lights->light);
        free(lights->fast);
        free(lights->begun);
        free(lights->plane);
        free(lights);
    }
}

uint32_t tof_virtual_lights_count(const tof_virtual_lights *lights)
{
    return lights->count;
}

/* ---- Gathering by Lambert's law ---- */

/* A block of places in floats, and what is summed there. */
typedef struct block
{
    float position[3][BLOCK];
    float normal[3][BLOCK];
    float way[3][BLOCK]; /* from a light */
    float u[BLOCK];
    float v[BLOCK];
    float height[BLOCK];
    uint8_t face[BLOCK];
    float total[BLOCK];
    float *real; /* waves x BLOCK */
    float *imaginary;
} block;

static void see_block(const tof_virtual_lights *lights, uint32_t which, size_t n, block *b)
{
    const float *const position[3] = {b->position[0], b->position[1], b->position[2]};
    float *const way[3] = {b->way[0], b->way[1], b->way[2]};
    lights->set->look(lights->fast + which, n, position, way);
    cm_forward_array_f32(lights->shadow_mapping, n, way[0], way[1], way[2], b->face, b->u, b->v);
    const gather_shadow shadow = {lights->shadow_edge,
                                  (const float(*)[4])lights->plane + which * lights->shadow_cells};
    lights->set->see(&shadow, n, position, b->face, b->u, b->v, b->height);
}

static void load_block(const tof_virtual_lights *lights, const tof_points *points, size_t begin,
                       size_t n, block *b)
{
    for (int k = 0; k < 3; k++)
    {
        for (size_t i = 0; i < BLOCK; i++)
        {
            const size_t from = begin + (i < n ? i : n - 1);
            b->position[k][i] = (float)(points->position[k][from] - lights->origin[k]);
            b->normal[k][i] = (float)points->normal[k][from];
        }
    }
    memset(b->total, 0, sizeof b->total);
    memset(b->real, 0, lights->waves.count * BLOCK * sizeof *b->real);
    memset(b->imaginary, 0, lights->waves.count * BLOCK * sizeof *b->imaginary);
}

static void gather_block(const tof_virtual_lights *lights, size_t n, block *b)
{
    const float *const position[3] = {b->position[0], b->position[1], b->position[2]};
    const float *const normal[3] = {b->normal[0], b->normal[1], b->normal[2]};
    const gather_sum sum = {b->total, b->real, b->imaginary, BLOCK};
    const size_t whole = (n + GATHER_ROOM - 1) / GATHER_ROOM * GATHER_ROOM;
    for (uint32_t which = 0; which < lights->lambert; which++)
    {
        const gather_waves waves = {lights->waves.count, lights->per_metre,
                                    lights->begun + which * lights->waves.count};
        if (lights->plane != NULL)
        {
            see_block(lights, which, whole, b);
        }
        lights->set->gather(lights->fast + which, &waves, whole, position, normal,
                            lights->plane != NULL ? b->height : NULL, &sum);
    }
}

/* Irradiance becomes radiance, and phases have the way to the camera. */
static void keep_block(const tof_virtual_lights *lights, const tof_points *points, size_t begin,
                       size_t n, const block *b, tof_radiance *radiance)
{
    const tof_surface *surface = tof_instant_surfaces(lights->instant);
    for (size_t i = 0; i < n; i++)
    {
        const size_t to = begin + i;
        const tof_surface *s = surface + points->id[to];
        if (!brdf_is_lambert(s->brdf))
        {
            continue;
        }
        const double scale = s->reflectance / PI;
        radiance->total[to] += scale * (double)b->total[i];
        for (size_t j = 0; j < lights->waves.count; j++)
        {
            const double phase = lights->waves.number[j] * points->range[to];
            const double re = scale * (double)b->real[j * BLOCK + i];
            const double im = scale * (double)b->imaginary[j * BLOCK + i];
            radiance->real[j * points->n + to] += re * cos(phase) - im * sin(phase);
            radiance->imaginary[j * points->n + to] += re * sin(phase) + im * cos(phase);
        }
    }
}

/* ---- Gathering by any law ---- */

static void add_pair(const tof_virtual_lights *lights, uint32_t which, const tof_points *points,
                     size_t i, tof_radiance *radiance)
{
    const tof_surface *surface = tof_instant_surfaces(lights->instant);
    const virtual_light *l = lights->light + which;
    const double at[3] = {points->position[0][i], points->position[1][i], points->position[2][i]};
    const double normal[3] = {points->normal[0][i], points->normal[1][i], points->normal[2][i]};
    const double out[3] = {points->to_camera[0][i], points->to_camera[1][i],
                           points->to_camera[2][i]};
    double way[3];
    double back[3];
    double square = 0.0;
    for (int k = 0; k < 3; k++)
    {
        way[k] = at[k] - l->position[k];
        square += way[k] * way[k];
    }
    const double distance = sqrt(square);
    double sent = 0.0;
    double received = 0.0;
    for (int k = 0; k < 3; k++)
    {
        way[k] /= distance;
        back[k] = -way[k];
        sent += way[k] * l->normal[k];
        received += back[k] * normal[k];
    }
    if (!(sent > 0.0 && received > 0.0) || (lights->plane != NULL && !is_seen(lights, which, at)))
    {
        return;
    }
    const double pair = fmin(sent * received / square, PI / l->area);
    const double here = surface[points->id[i]].reflectance *
                        cm_brdf_value(surface[points->id[i]].brdf, normal, back, out);
    const double there = cm_brdf_value(surface[l->id].brdf, l->normal, l->to_lamp, way);
    const double sum = l->flux * there * pair * here;
    radiance->total[i] += sum;
    for (size_t j = 0; j < lights->waves.count; j++)
    {
        const double phase = lights->waves.number[j] * (l->length + distance + points->range[i]);
        radiance->real[j * points->n + i] += sum * cos(phase);
        radiance->imaginary[j * points->n + i] += sum * sin(phase);
    }
}

static int has_lambert(const tof_virtual_lights *lights, const tof_points *points, size_t begin,
                       size_t n)
{
    const tof_surface *surface = tof_instant_surfaces(lights->instant);
    for (size_t i = begin; i < begin + n; i++)
    {
        if (brdf_is_lambert(surface[points->id[i]].brdf))
        {
            return 1;
        }
    }
    return 0;
}

cm_status tof_virtual_lights_add(const tof_virtual_lights *lights, const tof_points *points,
                                 tof_radiance *radiance)
{
    const tof_surface *surface = tof_instant_surfaces(lights->instant);
    block *const b = malloc(sizeof *b);
    float *const waves =
        cm_array_of(cm_size_sum(lights->waves.count, 1), 2 * BLOCK * sizeof *waves);
    if (b == NULL || waves == NULL)
    {
        free(b);
        free(waves);
        return CM_ERROR_MEMORY;
    }
    b->real = waves;
    b->imaginary = waves + lights->waves.count * BLOCK;
    for (size_t begin = 0; begin < points->n; begin += BLOCK)
    {
        const size_t n = points->n - begin < BLOCK ? points->n - begin : BLOCK;
        if (lights->lambert > 0 && has_lambert(lights, points, begin, n))
        {
            load_block(lights, points, begin, n, b);
            gather_block(lights, n, b);
            keep_block(lights, points, begin, n, b, radiance);
        }
        for (size_t i = begin; i < begin + n; i++)
        {
            const int fast = brdf_is_lambert(surface[points->id[i]].brdf);
            for (uint32_t which = fast ? lights->lambert : 0; which < lights->count; which++)
            {
                add_pair(lights, which, points, i, radiance);
            }
        }
    }
    free(b);
    free(waves);
    return CM_OK;
}
