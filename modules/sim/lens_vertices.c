/* SPDX-License-Identifier: MIT
 *
 * Lambers, Sommerhoff and Kolb 2018, section 3.2: geometry made ready for a pinhole.
 */
#include <cubemap/lens.h>

#include "lens_extent.h"

#include <math.h>

/* So many vertices are projected at once. */
#define BLOCK 256

/* Section 3.1, with the pixel's half where pixel_centre has it. */
static void make_frustum(const cm_camera_options *options, double frustum[4])
{
    const double edge = options->pixel_centre - 0.5;
    frustum[0] = (edge - options->cx) / options->fx;
    frustum[1] = (edge + options->width - options->cx) / options->fx;
    frustum[2] = (edge - options->cy) / options->fy;
    frustum[3] = (edge + options->height - options->cy) / options->fy;
}

cm_status cm_lens_frustum(const cm_camera *camera, double frustum[4])
{
    const cm_status status = cm_lens_check(camera);
    if (status != CM_OK || frustum == NULL)
    {
        return status != CM_OK ? status : CM_ERROR_ARGUMENT;
    }
    make_frustum(cm_camera_describe(camera), frustum);
    return CM_OK;
}

/* From -1 at the first edge to 1 at the second. */
static double normalised(double first, double second, double at)
{
    return ((at - first) + (at - second)) / (second - first);
}

cm_status cm_lens_guard(const cm_camera *camera, double delta, double *guard)
{
    cm_lens_extent extent;
    double frustum[4];
    cm_status status = cm_lens_check(camera);
    if (status != CM_OK || guard == NULL)
    {
        return status != CM_OK ? status : CM_ERROR_ARGUMENT;
    }
    if (!(delta >= 0.0) || isinf(delta))
    {
        return CM_ERROR_RANGE;
    }
    status = cm_lens_find_extent(camera, &extent);
    if (status != CM_OK)
    {
        return status;
    }
    make_frustum(cm_camera_describe(camera), frustum);
    double furthest = 1.0;
    for (int i = 0; i < 2; i++)
    {
        const double *side = &frustum[2 * i];
        furthest = fmax(furthest, fabs(normalised(side[0], side[1], extent.outer_least[i])));
        furthest = fmax(furthest, fabs(normalised(side[0], side[1], extent.outer_greatest[i])));
    }
    *guard = furthest + delta;
    return CM_OK;
}

static int is_inside(const double frustum[4], double guard, double x, double y, double z)
{
    return guard == 0.0 || (fabs(normalised(frustum[0], frustum[1], x / z)) <= guard &&
                            fabs(normalised(frustum[2], frustum[3], y / z)) <= guard);
}

cm_status cm_lens_move_vertices(const cm_camera *camera, double guard, size_t n, const double *x,
                                const double *y, const double *z, double *to_x, double *to_y,
                                double *to_z)
{
    const cm_status status = cm_lens_check(camera);
    if (status != CM_OK)
    {
        return status;
    }
    if (n > 0 &&
        (x == NULL || y == NULL || z == NULL || to_x == NULL || to_y == NULL || to_z == NULL))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(guard >= 0.0) || isinf(guard))
    {
        return CM_ERROR_RANGE;
    }
    const cm_camera_options *options = cm_camera_describe(camera);
    double frustum[4];
    make_frustum(options, frustum);
    for (size_t first = 0; first < n; first += BLOCK)
    {
        const size_t count = n - first < BLOCK ? n - first : BLOCK;
        double column[BLOCK], row[BLOCK];
        cm_camera_project_array(camera, count, x + first, y + first, z + first, column, row);
        for (size_t i = first; i < first + count; i++)
        {
            const int is_kept =
                !isnan(column[i - first]) && is_inside(frustum, guard, x[i], y[i], z[i]);
            const double depth = z[i];
            to_x[i] =
                is_kept ? depth * ((column[i - first] - options->cx) / options->fx) : (double)NAN;
            to_y[i] =
                is_kept ? depth * ((row[i - first] - options->cy) / options->fy) : (double)NAN;
            to_z[i] = is_kept ? depth : (double)NAN;
        }
    }
    return CM_OK;
}
