/* SPDX-License-Identifier: MIT
 *
 * Points: the pixel that the camera has them on.
 */
#include "raster_object.h"

#include <float.h>
#include <math.h>

#include "bands.h"

/* Points that are projected together. */
#define BLOCK 256

typedef struct drawing
{
    cm_raster *raster;
    const cm_pose *pose;
    const cm_points *points;
} drawing;

/* The pixel of a place; the last one at the picture's far edge. 0 if there is none. */
static int pixel_of(double place, double centre, size_t pixels, size_t *pixel)
{
    const double from_edge = place - centre + 0.5;
    if (!(from_edge >= 0.0 && from_edge <= (double)pixels))
    {
        return 0;
    }
    *pixel = (size_t)from_edge < pixels ? (size_t)from_edge : pixels - 1;
    return 1;
}

static void draw_block(const drawing *d, size_t begin, size_t n, size_t first, size_t last)
{
    cm_raster *raster = d->raster;
    const double centre = cm_camera_describe(raster->camera)->pixel_centre;
    double at[3][BLOCK];
    double column[BLOCK];
    double row[BLOCK];
    for (size_t i = 0; i < n; i++)
    {
        double p[3];
        cm_raster_transform(d->pose, d->points->position + 3 * (begin + i), p);
        at[0][i] = p[0];
        at[1][i] = p[1];
        at[2][i] = p[2];
    }
    cm_camera_project_array(raster->camera, n, at[0], at[1], at[2], column, row);
    for (size_t i = 0; i < n; i++)
    {
        size_t x;
        size_t y;
        const double range = hypot(hypot(at[0][i], at[1][i]), at[2][i]);
        const float near = (float)(1.0 / (raster->is_all_round ? range : at[2][i]));
        const uint32_t own = d->points->first_id + (uint32_t)(begin + i);
        if (!pixel_of(column[i], centre, raster->width, &x) ||
            !pixel_of(row[i], centre, raster->height, &y) || y < first || y >= last ||
            !(near > 0.0f && near <= raster->near_most))
        {
            continue;
        }
        int64_t *at_pixel = raster->key + cm_raster_place(raster->stride, x, y);
        const int64_t key = cm_raster_key(near, own);
        *at_pixel = key > *at_pixel ? key : *at_pixel;
    }
}

static void draw_band(size_t first, size_t last, size_t band, void *user)
{
    const drawing *d = user;
    (void)band;
    for (size_t i = 0; i < d->points->count; i += BLOCK)
    {
        const size_t left = d->points->count - i;
        draw_block(d, i, left < BLOCK ? left : BLOCK, first, last);
    }
}

cm_status cm_raster_points(cm_raster *raster, const cm_pose *pose, const cm_points *points,
                           unsigned threads)
{
    if (raster == NULL || points == NULL || points->size != sizeof *points ||
        (points->count > 0 && points->position == NULL))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cm_raster_check_ids(points->first_id, points->count) != CM_OK)
    {
        return CM_ERROR_RANGE;
    }
    drawing d = {raster, pose, points};
    cm_run_bands(raster->pool, cm_band_count(raster->pool, threads, raster->height, CM_TILE),
                 raster->height, CM_TILE, draw_band, &d);
    return CM_OK;
}
