/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "ray_table.h"

#include <math.h>
#include <stdlib.h>

int cm_camera_is_plain(const cm_camera_options *options)
{
    int is_plain = options->mapping == NULL;
    for (size_t i = 0; i < sizeof options->distortion / sizeof *options->distortion; i++)
    {
        is_plain = is_plain && options->distortion[i] == 0.0;
    }
    return is_plain;
}

size_t cm_camera_face_rows(const cm_camera_options *options)
{
    const int has_six = options->mapping != NULL && options->height / 6 == options->width;
    return has_six ? options->width : options->height;
}

size_t cm_row_stride(size_t width)
{
    return (width + 3 * (size_t)CM_DEPTH_SLACK - 1) / CM_DEPTH_SLACK * CM_DEPTH_SLACK;
}

int cm_row_desk_make(size_t count, cm_row_desk *desk)
{
    const size_t line = CM_DEPTH_SLACK * sizeof *desk->rows;
    desk->memory = cm_array_of(cm_size_sum(count, CM_DEPTH_SLACK), sizeof *desk->rows);
    if (desk->memory == NULL)
    {
        return 0;
    }
    const size_t off = (uintptr_t)desk->memory % line;
    desk->rows = (float *)((char *)desk->memory + (off == 0 ? 0 : line - off));
    return 1;
}

cm_ray_row cm_ray_row_at(const cm_rays *rays, size_t row)
{
    if (rays->is_separable)
    {
        return (cm_ray_row){.x = rays->x, .y_all = rays->y[row]};
    }
    const size_t first = row * rays->width;
    return (cm_ray_row){.x = rays->x + first, .y = rays->y + first, .z = rays->z + first};
}

/* In parts, since columns and rows of pixels are arrays. */
enum
{
    PART = 256
};

void cm_camera_rays_of_row(const cm_camera *camera, size_t row, size_t n, double *x, double *y,
                           double *z)
{
    const double centre = cm_camera_describe(camera)->pixel_centre;
    double columns[PART];
    double rows[PART];
    for (size_t first = 0; first < n; first += PART)
    {
        const size_t part = n - first < PART ? n - first : PART;
        for (size_t i = 0; i < part; i++)
        {
            columns[i] = (double)(first + i) + centre;
            rows[i] = (double)row + centre;
        }
        cm_camera_ray_array(camera, part, columns, rows, x + first, y + first, z + first);
    }
}

/* The root of the solid angle: a pixel's side, seen from the camera. */
static void fill_sides(const cm_camera *camera, const cm_rays *rays)
{
    const double centre = cm_camera_describe(camera)->pixel_centre;
    for (size_t i = 0; i < rays->width * rays->height; i++)
    {
        const double column = (double)(i % rays->width) + centre;
        const double row = (double)(i / rays->width) + centre;
        rays->pixel_side[i] = (float)sqrt(cm_camera_solid_angle(camera, column, row));
    }
}

static cm_status fill_all(const cm_camera *camera, const cm_rays *rays)
{
    const size_t width = rays->width;
    double *desk = cm_array_of(width, 3 * sizeof *desk);
    if (desk == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (size_t row = 0; row < rays->height; row++)
    {
        cm_camera_rays_of_row(camera, row, width, desk, desk + width, desk + 2 * width);
        for (size_t i = 0; i < width; i++)
        {
            rays->x[row * width + i] = (float)desk[i];
            rays->y[row * width + i] = (float)desk[width + i];
            rays->z[row * width + i] = (float)desk[2 * width + i];
        }
    }
    free(desk);
    if (rays->pixel_side != NULL)
    {
        fill_sides(camera, rays);
    }
    return CM_OK;
}

static void fill_separable(const cm_camera_options *options, const cm_rays *rays)
{
    for (size_t i = 0; i < rays->width; i++)
    {
        rays->x[i] = (float)(((double)i + options->pixel_centre - options->cx) / options->fx);
    }
    for (size_t i = 0; i < rays->height; i++)
    {
        rays->y[i] = (float)(((double)i + options->pixel_centre - options->cy) / options->fy);
    }
}

static cm_status fill(const cm_camera *camera, cm_rays *rays)
{
    const size_t pixels = rays->width * rays->height;
    const size_t columns = (rays->is_separable ? rays->width : pixels) + CM_DEPTH_SLACK;
    const size_t rows = (rays->is_separable ? rays->height : pixels) + CM_DEPTH_SLACK;
    const size_t all = cm_size_sum(cm_size_sum(columns, rows),
                                   (rays->is_separable ? 0 : columns) + CM_DEPTH_SLACK);
    rays->memory = calloc(all, sizeof *rays->memory);
    rays->pixel_side = rays->is_all_round ? cm_array_of(pixels, sizeof *rays->pixel_side) : NULL;
    if (rays->memory == NULL || (rays->is_all_round && rays->pixel_side == NULL))
    {
        return CM_ERROR_MEMORY;
    }
    rays->x = rays->memory + CM_DEPTH_SLACK;
    rays->y = rays->x + columns;
    rays->z = rays->is_separable ? NULL : rays->y + rows;
    if (rays->is_separable)
    {
        fill_separable(cm_camera_describe(camera), rays);
        return CM_OK;
    }
    return fill_all(camera, rays);
}

cm_status cm_rays_create(const cm_camera *camera, const char *instructions, cm_rays **rays)
{
    if (camera == NULL || rays == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_camera_options *options = cm_camera_describe(camera);
    const cm_depth_set *set = cm_depth_set_find(instructions);
    if (set == NULL)
    {
        return CM_ERROR_INSTRUCTIONS;
    }
    cm_rays *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *made = (cm_rays){.set = set,
                      .width = options->width,
                      .height = options->height,
                      .face_rows = cm_camera_face_rows(options),
                      .is_all_round = options->mapping != NULL,
                      .is_separable = cm_camera_is_plain(options),
                      .step_x = (float)(1.0 / options->fx),
                      .step_y = (float)(1.0 / options->fy),
                      .focal = (float)(0.5 * (fabs(options->fx) + fabs(options->fy)))};
    const cm_status status = fill(camera, made);
    if (status != CM_OK)
    {
        cm_rays_destroy(made);
        return status;
    }
    *rays = made;
    return CM_OK;
}

cm_status cm_rays_use_pool(cm_rays *rays, cm_pool *pool)
{
    if (rays == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    rays->pool = pool;
    return CM_OK;
}

size_t cm_rays_pixel_count(const cm_rays *rays)
{
    return rays == NULL ? 0 : rays->width * rays->height;
}

size_t cm_rays_halved_pixel_count(const cm_rays *rays)
{
    return rays == NULL ? 0 : (rays->width / 2) * (rays->height / 2);
}

void cm_rays_destroy(cm_rays *rays)
{
    if (rays != NULL)
    {
        free(rays->memory);
        free(rays->pixel_side);
        free(rays);
    }
}
