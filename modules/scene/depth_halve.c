/* SPDX-License-Identifier: MIT */
#include <cubemap/depth.h>

#include "bands.h"
#include "ray_table.h"

#define ROWS_AT_LEAST 16
#define GAP_MOST 1e6

typedef struct halving
{
    const cm_rays *rays;
    const float *from;
    float *to;
    float gap;
} halving;

static void halve_band(size_t first, size_t last, size_t band, void *user)
{
    const halving *h = user;
    const size_t width = h->rays->width;
    (void)band;
    for (size_t row = first; row < last; row++)
    {
        const float *above = h->from + 2 * row * width;
        h->rays->set->halve(width / 2, above, above + width, h->gap, h->to + row * (width / 2));
    }
}

cm_status cm_depth_halve(const cm_rays *rays, const float *from, double gap, unsigned threads,
                         float *to)
{
    if (rays == NULL || from == NULL || to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const int is_even = rays->width % 2 == 0 && rays->face_rows % 2 == 0;
    if (!(gap >= 0.0 && gap <= GAP_MOST) || rays->width < 2 || rays->height < 2 ||
        (rays->is_all_round && !is_even))
    {
        return CM_ERROR_RANGE;
    }
    halving h = {rays, from, to, (float)gap};
    const size_t rows = rays->height / 2;
    cm_run_bands(rays->pool, cm_band_count(rays->pool, threads, rows, ROWS_AT_LEAST), rows,
                 ROWS_AT_LEAST, halve_band, &h);
    return CM_OK;
}

cm_status cm_depth_halve_camera(const cm_camera_options *from, cm_camera_options *to)
{
    if (from == NULL || to == NULL || from->size != sizeof *from)
    {
        return CM_ERROR_ARGUMENT;
    }
    const int is_even = from->width % 2 == 0 && cm_camera_face_rows(from) % 2 == 0;
    if (from->width < 2 || from->height < 2 || (from->mapping != NULL && !is_even))
    {
        return CM_ERROR_RANGE;
    }
    cm_camera_options half = *from;
    /* from a picture's edge, which stays where it is, to half of that, and to the new pixels' centres */
    const double edge = 0.5 - from->pixel_centre;
    half.width = from->width / 2;
    half.height = from->height / 2;
    half.fx = from->fx / 2.0;
    half.fy = from->fy / 2.0;
    half.cx = (from->cx + edge) / 2.0 - edge;
    half.cy = (from->cy + edge) / 2.0 - edge;
    *to = half;
    return CM_OK;
}
