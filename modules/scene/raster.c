/* SPDX-License-Identifier: MIT
 *
 * The life of a canvas, and what is read from it.
 */
#include "modules/memory/checked_size.h"
#include "raster_object.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ray_table.h"

/* Coordinates of rays below this are 0: exact_side.h. */
#define RAY_LEAST 0x1p-200

cm_raster_rays cm_raster_rays_at(const cm_raster *raster, size_t column, size_t row)
{
    if (raster->is_plain)
    {
        return (cm_raster_rays){.x = raster->x + column, .y_all = raster->y[row]};
    }
    const size_t at = row * raster->width + column;
    return (cm_raster_rays){.x = raster->x + at, .y = raster->y + at, .z = raster->z + at};
}

cm_raster_pixels cm_raster_pixels_at(const cm_raster *raster, size_t column, size_t row,
                                     uint32_t own)
{
    return (cm_raster_pixels){.row = raster->key + cm_raster_place(raster->stride, 0, row),
                              .column = column,
                              .near_most = raster->near_most,
                              .own = own};
}

static void fill_plain(const cm_camera_options *options, cm_raster *raster)
{
    for (size_t i = 0; i < raster->width; i++)
    {
        raster->x[i] = ((double)i + options->pixel_centre - options->cx) / options->fx;
    }
    for (size_t i = 0; i < raster->height; i++)
    {
        raster->y[i] = ((double)i + options->pixel_centre - options->cy) / options->fy;
    }
}

static void fill_rays(cm_raster *raster)
{
    for (size_t row = 0; row < raster->height; row++)
    {
        const size_t at = row * raster->width;
        cm_camera_rays_of_row(raster->camera, row, raster->width, raster->x + at, raster->y + at,
                              raster->z + at);
    }
}

/* Numbers that are too small to be told from 0 become that, and the largest is found. */
static void settle_rays(cm_raster *raster, double *rays, size_t count)
{
    for (size_t i = 0; rays != NULL && i < count; i++)
    {
        const double size = fabs(rays[i]);
        rays[i] = size < RAY_LEAST ? 0.0 : rays[i];
        raster->ray_most = size > raster->ray_most ? size : raster->ray_most;
    }
}

/* Of pairs of rows. */
static size_t keys_of(const cm_raster *raster)
{
    return cm_size_product((raster->height + 1 + CM_RASTER_SLACK) / 2, raster->stride);
}

static void round_rays(cm_raster *raster)
{
    for (size_t i = 0; i < raster->width; i++)
    {
        raster->column_x[i] = (float)raster->x[i];
    }
    for (size_t i = 0; i < raster->height; i++)
    {
        raster->row_y[i] = (float)raster->y[i];
    }
}

static cm_status take_memory(cm_raster *raster)
{
    const size_t pixels = raster->width * raster->height;
    const size_t columns = raster->is_plain ? raster->width : pixels;
    const size_t rows = raster->is_plain ? raster->height : pixels;
    const size_t line = 64;
    raster->x = calloc(columns, sizeof *raster->x);
    raster->y = calloc(rows, sizeof *raster->y);
    raster->z = raster->is_plain ? NULL : calloc(pixels, sizeof *raster->z);
    raster->column_x =
        raster->is_plain ? calloc(columns + rows + 2 * CM_RASTER_SLACK, sizeof(float)) : NULL;
    raster->key_memory =
        cm_array_of(cm_size_sum(keys_of(raster), line / sizeof *raster->key), sizeof *raster->key);
    if (raster->x == NULL || raster->y == NULL || raster->key_memory == NULL ||
        (raster->is_plain ? raster->column_x == NULL : raster->z == NULL))
    {
        return CM_ERROR_MEMORY;
    }
    raster->row_y = raster->is_plain ? raster->column_x + columns + CM_RASTER_SLACK : NULL;
    char *begin = raster->key_memory;
    raster->key = (int64_t *)(void *)(begin + (line - (uintptr_t)begin % line));
    return CM_OK;
}

static cm_status fill(cm_raster *raster)
{
    const size_t pixels = raster->width * raster->height;
    const cm_status status = take_memory(raster);
    if (status != CM_OK)
    {
        return status;
    }
    if (raster->is_plain)
    {
        fill_plain(cm_camera_describe(raster->camera), raster);
    }
    else
    {
        fill_rays(raster);
    }
    raster->ray_most = 1.0;
    settle_rays(raster, raster->x, raster->is_plain ? raster->width : pixels);
    settle_rays(raster, raster->y, raster->is_plain ? raster->height : pixels);
    settle_rays(raster, raster->z, pixels);
    if (raster->is_plain)
    {
        round_rays(raster);
    }
    cm_raster_clear(raster);
    return cm_raster_make_tiles(raster);
}

cm_status cm_raster_create(const cm_camera *camera, double nearest, const char *instructions,
                           cm_raster **raster)
{
    if (camera == NULL || raster == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(nearest >= 0.0 && nearest <= DBL_MAX))
    {
        return CM_ERROR_RANGE;
    }
    const cm_camera_options *options = cm_camera_describe(camera);
    const cm_raster_set *set = cm_raster_set_find(instructions);
    if (set == NULL)
    {
        return CM_ERROR_INSTRUCTIONS;
    }
    cm_raster *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *made = (cm_raster){.camera = camera,
                        .set = set,
                        .width = options->width,
                        .height = options->height,
                        .stride = ((size_t)options->width + 1 + CM_RASTER_SLACK) / 2 * 4,
                        .is_plain =
                            cm_camera_is_plain(options) && options->fx > 0.0 && options->fy > 0.0,
                        .is_all_round = options->mapping != NULL,
                        .near_most = nearest * FLT_MAX > 1.0 ? (float)(1.0 / nearest) : FLT_MAX};
    const cm_status status = fill(made);
    if (status != CM_OK)
    {
        cm_raster_destroy(made);
        return status;
    }
    *raster = made;
    return CM_OK;
}

void cm_raster_destroy(cm_raster *raster)
{
    if (raster != NULL)
    {
        for (size_t i = 0; i < raster->levels; i++)
        {
            free(raster->level[i].cone);
        }
        free(raster->x);
        free(raster->y);
        free(raster->z);
        free(raster->column_x);
        free(raster->key_memory);
        free(raster);
    }
}

cm_status cm_raster_use_pool(cm_raster *raster, cm_pool *pool)
{
    if (raster == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    raster->pool = pool;
    return CM_OK;
}

size_t cm_raster_pixel_count(const cm_raster *raster)
{
    return raster == NULL ? 0 : raster->width * raster->height;
}

void cm_raster_clear(cm_raster *raster)
{
    for (size_t i = 0; raster != NULL && i < keys_of(raster); i++)
    {
        raster->key[i] = CM_RASTER_EMPTY;
    }
}

cm_status cm_raster_read(const cm_raster *raster, float *image, uint32_t *id)
{
    if (raster == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    for (size_t row = 0; row < raster->height; row++)
    {
        const int64_t *key = raster->key + cm_raster_place(raster->stride, 0, row);
        const size_t at = row * raster->width;
        raster->set->read_row(raster->width, key, image == NULL ? NULL : image + at,
                              id == NULL ? NULL : id + at);
    }
    return CM_OK;
}

void cm_raster_transform(const cm_pose *pose, const double world[3], double camera[3])
{
    if (pose != NULL)
    {
        cm_pose_apply(pose, world, camera);
        return;
    }
    memcpy(camera, world, 3 * sizeof *camera);
}

cm_status cm_raster_check_ids(uint32_t first, size_t count)
{
    return count <= (size_t)(CM_RASTER_NOTHING - first) ? CM_OK : CM_ERROR_RANGE;
}
