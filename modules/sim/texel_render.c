/* SPDX-License-Identifier: MIT
 *
 * Killpack 2016, algorithms 2 and 3, with rays in the place of a z-buffer: depth comes along the axis at once.
 */
#include "modules/memory/checked_size.h"
#include "texel_canvas.h"

#include <math.h>
#include <stdlib.h>

/* Rays at once: those of one pixel at least. */
#define BLOCK 256
#define LEAST 1024

typedef struct canvas
{
    const cm_scene *scene;
    const cm_pose *pose;
    const cm_texel_options *options;
    float *color; /* NULL: not wanted */
    float *depth; /* in metres */
} canvas;

typedef struct rays
{
    double origin[3][BLOCK];
    double direction[3][BLOCK];
    double distance[BLOCK];
    double color[3][BLOCK];
} rays;

/* The pose's rows are the camera's axes in the world; a direction's z is 1, so that distance is depth. */
static void aim(const canvas *work, double column, double row, size_t at, rays *ray)
{
    const double focal = cm_texel_focal(work->options);
    const double a = (column - 0.5 * work->options->width) / focal;
    const double b = (row - 0.5 * work->options->height) / focal;
    for (int i = 0; i < 3; i++)
    {
        const cm_rotation *axes = &work->pose->rotation;
        ray->direction[i][at] = a * axes->row[0][i] + b * axes->row[1][i] + axes->row[2][i];
        ray->origin[i][at] = work->pose->position[i];
    }
}

static void aim_pixels(const canvas *work, size_t first, size_t count, rays *ray)
{
    const uint32_t times = work->options->oversampling;
    size_t at = 0;
    for (size_t i = first; i < first + count; i++)
    {
        const double column = (double)(i % work->options->width);
        const double row = (double)(i / work->options->width);
        for (uint32_t k = 0; k < times * times; k++)
        {
            aim(work, column + (k % times + 0.5) / times, row + (k / times + 0.5) / times, at++,
                ray);
        }
    }
}

/* The mean of what the rays of a pixel met; those that met nothing are black, and have no depth. */
static void put_pixel(const canvas *work, const rays *ray, size_t from, size_t pixel)
{
    const size_t count = (size_t)work->options->oversampling * work->options->oversampling;
    double sum[3] = {0.0, 0.0, 0.0}, depth = 0.0, met = 0.0;
    for (size_t i = from; i < from + count; i++)
    {
        for (int c = 0; c < 3; c++)
        {
            sum[c] += ray->color[c][i];
        }
        if (isfinite(ray->distance[i]))
        {
            depth += ray->distance[i];
            met += 1.0;
        }
    }
    for (int c = 0; c < 3 && work->color != NULL; c++)
    {
        work->color[3 * pixel + (size_t)c] = (float)(sum[c] / (double)count);
    }
    work->depth[pixel] = met > 0.0 ? (float)(work->options->unit * depth / met) : (float)NAN;
}

static void cast_pixels(size_t begin, size_t end, void *user)
{
    const canvas *work = user;
    const size_t each = (size_t)work->options->oversampling * work->options->oversampling;
    rays ray;
    const cm_hit_arrays hit = {.size = sizeof hit,
                               .distance = ray.distance,
                               .color = {ray.color[0], ray.color[1], ray.color[2]}};
    for (size_t first = begin; first < end; first += BLOCK / each)
    {
        const size_t count = end - first < BLOCK / each ? end - first : BLOCK / each;
        aim_pixels(work, first, count, &ray);
        cm_scene_cast_array(work->scene, count * each, ray.origin[0], ray.origin[1], ray.origin[2],
                            ray.direction[0], ray.direction[1], ray.direction[2], &hit);
        for (size_t i = 0; i < count; i++)
        {
            put_pixel(work, &ray, i * each, first + i);
        }
    }
}

static int wants_depth(const cm_texel_image *image)
{
    return image->depth != NULL || image->range != NULL || image->point[0] != NULL ||
           image->point[1] != NULL || image->point[2] != NULL;
}

/* All but the memory: memory has room for the canvas and for samples. */
static void render(const canvas *work, const cm_texel_grid *grid, cm_pool *pool, float *memory,
                   const cm_texel_image *image)
{
    const size_t pixels = (size_t)work->options->width * work->options->height;
    for (size_t i = 0; i < pixels; i++)
    {
        memory[i] = (float)NAN;
    }
    if (image->color != NULL || wants_depth(image))
    {
        cm_pool_run(pool, pixels, LEAST, cast_pixels, (void *)(uintptr_t)work);
    }
    cm_texel_take_means(work->options, grid, memory, memory + pixels);
    cm_texel_take_points(work->options, grid, memory + pixels, image);
}

cm_status cm_texel_render(const cm_scene *scene, const cm_pose *pose,
                          const cm_texel_options *options, cm_pool *pool,
                          const cm_texel_image *image)
{
    cm_texel_options complete;
    cm_texel_grid grid;
    cm_status status = cm_texel_completed(options, &complete);
    if (status != CM_OK || scene == NULL || pose == NULL || image == NULL ||
        image->size != sizeof *image)
    {
        return status != CM_OK ? status : CM_ERROR_ARGUMENT;
    }
    if (cm_pose_check(pose) != CM_OK)
    {
        return CM_ERROR_CAMERA;
    }
    const size_t pixels = (size_t)complete.width * complete.height;
    const size_t samples = (size_t)complete.columns * complete.rows;
    float *memory = cm_array_of(pixels + samples, sizeof *memory);
    if (memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    status = cm_texel_make_grid(&complete, &grid);
    if (status == CM_OK)
    {
        const canvas work = {scene, pose, &complete, image->color, memory};
        render(&work, &grid, pool, memory, image);
        cm_texel_drop_grid(&grid);
    }
    free(memory);
    return status;
}
