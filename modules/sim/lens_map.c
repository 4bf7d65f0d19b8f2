/* SPDX-License-Identifier: MIT
 *
 * Undistorted pictures to distorted ones: Lambers, Sommerhoff and Kolb 2018, section 3.3.
 */
#include <cubemap/lens.h>

#include "modules/memory/checked_size.h"
#include "lens_extent.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pixels that a thread takes at least, and that are looked at at once. */
#define LEAST 4096
#define BLOCK 256

/* The gap that 0 stands for, as in depth.h. */
#define GAP 0.05

struct cm_lens_map
{
    const cm_camera *camera;
    const cm_camera *pinhole;
    size_t pixels;
    size_t unfilled;
    double *column; /* in the undistorted picture; NaN where it shows nothing */
    double *row;
};

/* Four pixels around a place, and how much the second of each direction weighs. */
typedef struct quad
{
    size_t at[4];
    size_t nearest;
    double right, below;
} quad;

/* ---- the map ---- */

static int is_within(double at, double pixel_centre, uint32_t count)
{
    return at >= pixel_centre - 0.5 && at < pixel_centre - 0.5 + (double)count;
}

static void find_places(size_t begin, size_t end, void *user)
{
    cm_lens_map *map = user;
    const cm_camera_options *options = cm_camera_describe(map->camera);
    const cm_camera_options *shown = cm_camera_describe(map->pinhole);
    double x[BLOCK], y[BLOCK], z[BLOCK];
    for (size_t first = begin; first < end; first += BLOCK)
    {
        const size_t count = end - first < BLOCK ? end - first : BLOCK;
        double *column = map->column + first, *row = map->row + first;
        for (size_t i = 0; i < count; i++)
        {
            column[i] = options->pixel_centre + (double)((first + i) % options->width);
            row[i] = options->pixel_centre + (double)((first + i) / options->width);
        }
        cm_camera_ray_array(map->camera, count, column, row, x, y, z);
        cm_camera_project_array(map->pinhole, count, x, y, z, column, row);
        for (size_t i = 0; i < count; i++)
        {
            if (!is_within(column[i], shown->pixel_centre, shown->width) ||
                !is_within(row[i], shown->pixel_centre, shown->height))
            {
                /* an infinite row tells what has a ray until all are counted */
                row[i] = isnan(x[i]) ? (double)NAN : (double)INFINITY;
                column[i] = (double)NAN;
            }
        }
    }
}

static void count_unfilled(cm_lens_map *map)
{
    for (size_t i = 0; i < map->pixels; i++)
    {
        if (isinf(map->row[i]))
        {
            map->unfilled++;
            map->row[i] = (double)NAN;
        }
    }
}

static int is_pinhole(const cm_camera_options *options)
{
    for (int i = 0; i < 14; i++)
    {
        if (options->distortion[i] != 0.0)
        {
            return 0;
        }
    }
    return 1;
}

cm_status cm_lens_map_create(const cm_camera *camera, const cm_camera *pinhole, cm_pool *pool,
                             cm_lens_map **map)
{
    const cm_status status = cm_lens_check(camera);
    const cm_status other = cm_lens_check(pinhole);
    if (status != CM_OK || other != CM_OK || map == NULL)
    {
        return status != CM_OK ? status : other != CM_OK ? other : CM_ERROR_ARGUMENT;
    }
    if (!is_pinhole(cm_camera_describe(pinhole)))
    {
        return CM_ERROR_CAMERA;
    }
    const cm_camera_options *options = cm_camera_describe(camera);
    cm_lens_map *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    made->camera = camera;
    made->pinhole = pinhole;
    made->pixels = (size_t)options->width * options->height;
    made->column = cm_array_of(made->pixels, 2 * sizeof *made->column);
    if (made->column == NULL)
    {
        free(made);
        return CM_ERROR_MEMORY;
    }
    made->row = made->column + made->pixels;
    cm_pool_run(pool, made->pixels, LEAST, find_places, made);
    count_unfilled(made);
    *map = made;
    return CM_OK;
}

void cm_lens_map_destroy(cm_lens_map *map)
{
    if (map != NULL)
    {
        free(map->column);
        free(map);
    }
}

size_t cm_lens_map_unfilled(const cm_lens_map *map)
{
    return map == NULL ? 0 : map->unfilled;
}

size_t cm_lens_map_pixel_count(const cm_lens_map *map)
{
    return map == NULL ? 0 : map->pixels;
}

size_t cm_lens_map_pinhole_pixel_count(const cm_lens_map *map)
{
    const cm_camera_options *shown = map == NULL ? NULL : cm_camera_describe(map->pinhole);
    return shown == NULL ? 0 : (size_t)shown->width * shown->height;
}

cm_status cm_lens_map_places(const cm_lens_map *map, double *column, double *row)
{
    if (map == NULL || column == NULL || row == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    memcpy(column, map->column, map->pixels * sizeof *column);
    memcpy(row, map->row, map->pixels * sizeof *row);
    return CM_OK;
}

/* ---- pictures ---- */

/* What a picture is taken from and to. */
typedef struct picture
{
    const cm_lens_map *map;
    const void *from;
    void *to;
    size_t channels; /* or bytes */
    double gap;
    const void *nothing;
} picture;

/* The index before a place, no less than 0, and the one behind it, which the picture has. */
static double find_pair(double at, uint32_t count, size_t *before, size_t *behind)
{
    const double inside = fmin(fmax(at, 0.0), (double)(count - 1));
    *before = (size_t)inside;
    *behind = *before + 1 < count ? *before + 1 : *before;
    return inside - (double)*before;
}

static int find_quad(const cm_lens_map *map, size_t pixel, quad *around)
{
    const cm_camera_options *shown = cm_camera_describe(map->pinhole);
    size_t left, right, above, below;
    if (isnan(map->column[pixel]))
    {
        return 0;
    }
    around->right =
        find_pair(map->column[pixel] - shown->pixel_centre, shown->width, &left, &right);
    around->below = find_pair(map->row[pixel] - shown->pixel_centre, shown->height, &above, &below);
    around->at[0] = above * shown->width + left;
    around->at[1] = above * shown->width + right;
    around->at[2] = below * shown->width + left;
    around->at[3] = below * shown->width + right;
    around->nearest = around->at[(around->right >= 0.5) + 2 * (around->below >= 0.5)];
    return 1;
}

static double mix(const quad *around, const double value[4])
{
    const double above = value[0] + around->right * (value[1] - value[0]);
    const double below = value[2] + around->right * (value[3] - value[2]);
    return above + around->below * (below - above);
}

static void take_colors(size_t begin, size_t end, void *user)
{
    const picture *work = user;
    const float *from = work->from;
    float *to = work->to;
    for (size_t i = begin; i < end; i++)
    {
        quad around;
        const int is_shown = find_quad(work->map, i, &around);
        for (size_t c = 0; c < work->channels; c++)
        {
            double value[4];
            for (int k = 0; k < 4 && is_shown; k++)
            {
                value[k] = (double)from[around.at[k] * work->channels + c];
            }
            const double mixed = is_shown ? mix(&around, value) : (double)NAN;
            to[i * work->channels + c] = !is_shown ? (float)NAN
                                         : isfinite(mixed)
                                             ? (float)mixed
                                             : from[around.nearest * work->channels + c];
        }
    }
}

static int is_measured(float depth)
{
    return depth > 0.0f && !isinf(depth);
}

static float take_depth(const picture *work, const quad *around)
{
    const float *from = work->from;
    const float nearest = from[around->nearest];
    double least = (double)INFINITY, most = 0.0, inverse[4];
    for (int k = 0; k < 4; k++)
    {
        const float depth = from[around->at[k]];
        if (!is_measured(depth))
        {
            return is_measured(nearest) ? nearest : (float)NAN;
        }
        least = fmin(least, (double)depth);
        most = fmax(most, (double)depth);
        inverse[k] = 1.0 / (double)depth;
    }
    return most - least > work->gap * least ? nearest : (float)(1.0 / mix(around, inverse));
}

static void take_depths(size_t begin, size_t end, void *user)
{
    const picture *work = user;
    float *to = work->to;
    for (size_t i = begin; i < end; i++)
    {
        quad around;
        to[i] = find_quad(work->map, i, &around) ? take_depth(work, &around) : (float)NAN;
    }
}

static void take_labels(size_t begin, size_t end, void *user)
{
    const picture *work = user;
    const unsigned char *from = work->from;
    unsigned char *to = work->to;
    for (size_t i = begin; i < end; i++)
    {
        quad around;
        const void *label = find_quad(work->map, i, &around)
                                ? from + around.nearest * work->channels
                                : work->nothing;
        memcpy(to + i * work->channels, label, work->channels);
    }
}

/* Where flows that begin at pixels from first on end on the undistorted picture; NaN where there is none. */
static void find_ends(const picture *work, size_t first, size_t count, double *column, double *row)
{
    const cm_lens_map *map = work->map;
    const float *from = work->from;
    for (size_t i = 0; i < count; i++)
    {
        quad around;
        column[i] = row[i] = (double)NAN;
        if (find_quad(map, first + i, &around))
        {
            column[i] = map->column[first + i] + (double)from[2 * around.nearest];
            row[i] = map->row[first + i] + (double)from[2 * around.nearest + 1];
        }
    }
}

/* From places by the flow to its ends, and back through the lens. */
static void take_flows(size_t begin, size_t end, void *user)
{
    const picture *work = user;
    const cm_camera_options *options = cm_camera_describe(work->map->camera);
    double column[BLOCK], row[BLOCK], x[BLOCK], y[BLOCK], z[BLOCK];
    float *to = work->to;
    for (size_t first = begin; first < end; first += BLOCK)
    {
        const size_t count = end - first < BLOCK ? end - first : BLOCK;
        find_ends(work, first, count, column, row);
        cm_camera_ray_array(work->map->pinhole, count, column, row, x, y, z);
        cm_camera_project_array(work->map->camera, count, x, y, z, column, row);
        for (size_t i = 0; i < count; i++)
        {
            const double from_column = (double)((first + i) % options->width);
            const double from_row = (double)((first + i) / options->width);
            to[2 * (first + i)] = (float)(column[i] - options->pixel_centre - from_column);
            to[2 * (first + i) + 1] = (float)(row[i] - options->pixel_centre - from_row);
        }
    }
}

static cm_status take(const picture *work, cm_pool *pool, cm_job job)
{
    if (work->map == NULL || work->from == NULL || work->to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (work->channels == 0)
    {
        return CM_ERROR_RANGE;
    }
    cm_pool_run(pool, work->map->pixels, LEAST, job, (void *)(uintptr_t)work);
    return CM_OK;
}

cm_status cm_lens_map_color(const cm_lens_map *map, uint32_t channels, const float *from, float *to,
                            cm_pool *pool)
{
    const picture work = {.map = map, .from = from, .to = to, .channels = channels};
    return take(&work, pool, take_colors);
}

cm_status cm_lens_map_depth(const cm_lens_map *map, double gap, const float *from, float *to,
                            cm_pool *pool)
{
    const picture work = {
        .map = map, .from = from, .to = to, .channels = gap >= 0.0, .gap = gap == 0.0 ? GAP : gap};
    return take(&work, pool, take_depths);
}

cm_status cm_lens_map_labels(const cm_lens_map *map, size_t bytes, const void *from,
                             const void *nothing, void *to, cm_pool *pool)
{
    const picture work = {
        .map = map, .from = from, .to = to, .channels = bytes, .nothing = nothing};
    return nothing == NULL ? CM_ERROR_ARGUMENT : take(&work, pool, take_labels);
}

cm_status cm_lens_map_flow(const cm_lens_map *map, const float *from, float *to, cm_pool *pool)
{
    const picture work = {.map = map, .from = from, .to = to, .channels = 2};
    return take(&work, pool, take_flows);
}
