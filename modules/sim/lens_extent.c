/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "lens_extent.h"

#include <math.h>
#include <stdlib.h>

/* Rays of a row of places, and of the row above it. */
typedef struct ray_rows
{
    double *column, *row;
    double *x, *y, *z;
    double *above_x, *above_y;
} ray_rows;

cm_status cm_lens_check(const cm_camera *camera)
{
    return camera == NULL                                ? CM_ERROR_ARGUMENT
           : cm_camera_describe(camera)->mapping != NULL ? CM_ERROR_UNSUPPORTED
                                                         : CM_OK;
}

static void make_rays(const cm_camera *camera, size_t n, double column, double row, ray_rows *rows)
{
    for (size_t i = 0; i < n; i++)
    {
        rows->column[i] = column + (double)i;
        rows->row[i] = row;
    }
    cm_camera_ray_array(camera, n, rows->column, rows->row, rows->x, rows->y, rows->z);
}

/* fmin and fmax leave NaN out. */
static void widen(size_t n, const double *x, const double *y, double least[2], double greatest[2])
{
    for (size_t i = 0; i < n; i++)
    {
        least[0] = fmin(least[0], x[i]);
        least[1] = fmin(least[1], y[i]);
        greatest[0] = fmax(greatest[0], x[i]);
        greatest[1] = fmax(greatest[1], y[i]);
    }
}

static void narrow(const cm_camera_options *options, size_t n, const ray_rows *rows,
                   cm_lens_extent *extent)
{
    for (size_t i = 0; i < n; i++)
    {
        extent->step = fmin(extent->step, hypot(options->fx * (rows->x[i] - rows->above_x[i]),
                                                options->fy * (rows->y[i] - rows->above_y[i])));
        if (i > 0)
        {
            extent->step = fmin(extent->step, hypot(options->fx * (rows->x[i] - rows->x[i - 1]),
                                                    options->fy * (rows->y[i] - rows->y[i - 1])));
        }
    }
}

static void look(const cm_camera *camera, ray_rows *rows, cm_lens_extent *extent)
{
    const cm_camera_options *options = cm_camera_describe(camera);
    const size_t width = options->width;
    const double edge = options->pixel_centre - 0.5;
    for (uint32_t j = 0; j <= options->height; j++)
    {
        make_rays(camera, width + 1, edge, edge + (double)j, rows);
        widen(width + 1, rows->x, rows->y, extent->outer_least, extent->outer_greatest);
    }
    for (size_t i = 0; i < width; i++)
    {
        rows->above_x[i] = rows->above_y[i] = (double)NAN;
    }
    for (uint32_t j = 0; j < options->height; j++)
    {
        make_rays(camera, width, options->pixel_centre, options->pixel_centre + (double)j, rows);
        widen(width, rows->x, rows->y, extent->least, extent->greatest);
        narrow(options, width, rows, extent);
        for (size_t i = 0; i < width; i++)
        {
            rows->above_x[i] = rows->x[i];
            rows->above_y[i] = rows->y[i];
        }
    }
    for (int i = 0; i < 2; i++)
    {
        extent->outer_least[i] = fmin(extent->outer_least[i], extent->least[i]);
        extent->outer_greatest[i] = fmax(extent->outer_greatest[i], extent->greatest[i]);
    }
}

cm_status cm_lens_find_extent(const cm_camera *camera, cm_lens_extent *extent)
{
    const double all = (double)INFINITY;
    const size_t n = (size_t)cm_camera_describe(camera)->width + 1;
    cm_lens_extent found = {{all, all}, {-all, -all}, {all, all}, {-all, -all}, all};
    double *memory = cm_array_of(n, 7 * sizeof *memory);
    if (memory == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    ray_rows rows = {memory,         memory + n,     memory + 2 * n, memory + 3 * n,
                     memory + 4 * n, memory + 5 * n, memory + 6 * n};
    look(camera, &rows, &found);
    free(memory);
    if (!(found.least[0] <= found.greatest[0]))
    {
        return CM_ERROR_RANGE;
    }
    *extent = found;
    return CM_OK;
}
