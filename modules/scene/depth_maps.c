/* SPDX-License-Identifier: MIT */
#include <cubemap/depth.h>

#include <math.h>
#include <stdlib.h>

#include "bands.h"
#include "ray_table.h"

#define GAP 0.05
#define ROWS_AT_LEAST 16

/* ---- depth and range ---- */

typedef struct ranging
{
    const cm_rays *rays;
    const float *from;
    float *to;
    int is_back;
} ranging;

static void range_band(size_t first, size_t last, size_t band, void *user)
{
    const ranging *r = user;
    (void)band;
    for (size_t row = first; row < last; row++)
    {
        const cm_ray_row ray = cm_ray_row_at(r->rays, row);
        const size_t at = row * r->rays->width;
        (r->is_back ? r->rays->set->from_range : r->rays->set->to_range)(r->rays->width, &ray,
                                                                         r->from + at, r->to + at);
    }
}

static cm_status change(const cm_rays *rays, const float *from, unsigned threads, float *to,
                        int is_back)
{
    if (rays == NULL || from == NULL || to == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (rays->is_all_round)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    ranging r = {rays, from, to, is_back};
    cm_run_bands(rays->pool, cm_band_count(rays->pool, threads, rays->height, ROWS_AT_LEAST),
                 rays->height, ROWS_AT_LEAST, range_band, &r);
    return CM_OK;
}

cm_status cm_depth_to_range(const cm_rays *rays, const float *depth, unsigned threads, float *range)
{
    return change(rays, depth, threads, range, 0);
}

cm_status cm_depth_from_range(const cm_rays *rays, const float *range, unsigned threads,
                              float *depth)
{
    return change(rays, range, threads, depth, 1);
}

/* ---- maps ---- */

/* Rows of a band that are on the desk: three depths, in turn, and one without any. */
enum
{
    DESK_DEPTHS = 3,
    DESK_ROWS
};

typedef struct mapping_rows
{
    const cm_rays *rays;
    const float *image;
    const cm_depth_maps *maps;
    float gap;
    int is_range;  /* and the camera has depths */
    size_t stride; /* floats of a row of the desk */
    float *desk;   /* DESK_ROWS of each band */
} mapping_rows;

/* A row's depths, NaN where there is none, to where they belong. */
static void take_depths(const mapping_rows *m, size_t row, float *to)
{
    const cm_rays *rays = m->rays;
    const float *values = m->image + row * rays->width;
    if (m->is_range)
    {
        const cm_ray_row ray = cm_ray_row_at(rays, row);
        rays->set->from_range(rays->width, &ray, values, to);
    }
    else
    {
        rays->set->clean(rays->width, values, to);
    }
}

static void point_to_row(float *const planes[3], size_t width, size_t row, float *to[3])
{
    for (int k = 0; k < 3; k++)
    {
        to[k] = planes[k] + row * width;
    }
}

static void radii_of(const mapping_rows *m, size_t row)
{
    const cm_rays *rays = m->rays;
    const size_t at = row * rays->width;
    const double root_of_two = 1.4142135623730951;
    float *vertex[3];
    float *normal[3];
    point_to_row(m->maps->vertex, rays->width, row, vertex);
    point_to_row(m->maps->normal, rays->width, row, normal);
    if (rays->is_all_round)
    {
        rays->set->radii_all_round(rays->width, m->image + at, rays->pixel_side + at,
                                   (const float *const *)vertex, (const float *const *)normal,
                                   m->maps->radius + at);
    }
    else
    {
        rays->set->radii(rays->width, vertex[2], normal[2], (float)(root_of_two / rays->focal),
                         m->maps->radius + at);
    }
}

static float *desk_row(const mapping_rows *m, float *desk, size_t row)
{
    return desk + row % DESK_DEPTHS * m->stride + CM_DEPTH_SLACK;
}

/* Row -1, 0 or 1 from one: what is beyond a face's end is empty, and its rays do not matter. */
static void point_beside(const mapping_rows *m, size_t row, int beside, float *desk,
                         cm_map_rows *rows)
{
    const size_t faces = m->rays->face_rows;
    const int is_end = (beside < 0 && row % faces == 0) || (beside > 0 && (row + 1) % faces == 0);
    const size_t wanted = is_end ? row : row + (size_t)beside;
    rows->depth[1 + beside] =
        is_end ? desk + DESK_DEPTHS * m->stride + CM_DEPTH_SLACK : desk_row(m, desk, wanted);
    rows->ray[1 + beside] = cm_ray_row_at(m->rays, wanted);
}

static void map_row(const mapping_rows *m, size_t row, float *desk)
{
    const cm_rays *rays = m->rays;
    cm_map_rows rows = {.gap = m->gap,
                        .step_x = rays->step_x,
                        .step_y = rays->step_y,
                        .side = (rays->step_x < 0.0f) != (rays->step_y < 0.0f) ? -1.0f : 1.0f};
    float *vertex[3];
    float *normal[3];
    for (int beside = -1; beside <= 1; beside++)
    {
        point_beside(m, row, beside, desk, &rows);
    }
    point_to_row(m->maps->vertex, rays->width, row, vertex);
    point_to_row(m->maps->normal, rays->width, row, normal);
    rays->set->maps(rays->width, &rows, vertex, normal);
    if (m->maps->radius != NULL)
    {
        radii_of(m, row);
    }
}

static float *band_desk(const mapping_rows *m, size_t band)
{
    float *desk = m->desk + band * DESK_ROWS * m->stride;
    for (size_t i = 0; i < DESK_ROWS * m->stride; i++)
    {
        desk[i] = NAN;
    }
    return desk;
}

static void map_band(size_t first, size_t last, size_t band, void *user)
{
    const mapping_rows *m = user;
    float *desk = band_desk(m, band);
    for (size_t row = first > 0 ? first - 1 : 0; row <= first && row < last; row++)
    {
        take_depths(m, row, desk_row(m, desk, row));
    }
    for (size_t row = first; row < last; row++)
    {
        if (row + 1 < m->rays->height)
        {
            take_depths(m, row + 1, desk_row(m, desk, row + 1));
        }
        map_row(m, row, desk);
    }
}

static void vertex_band(size_t first, size_t last, size_t band, void *user)
{
    const mapping_rows *m = user;
    float *depths = m->desk + band * DESK_ROWS * m->stride;
    for (size_t row = first; row < last; row++)
    {
        const cm_ray_row ray = cm_ray_row_at(m->rays, row);
        float *vertex[3];
        take_depths(m, row, depths);
        point_to_row(m->maps->vertex, m->rays->width, row, vertex);
        m->rays->set->vertices(m->rays->width, &ray, depths, vertex);
    }
}

static int are_maps(const cm_depth_maps *maps)
{
    const int vertices =
        (maps->vertex[0] != NULL) + (maps->vertex[1] != NULL) + (maps->vertex[2] != NULL);
    const int normals =
        (maps->normal[0] != NULL) + (maps->normal[1] != NULL) + (maps->normal[2] != NULL);
    return vertices == 3 && normals % 3 == 0 && (normals == 3 || maps->radius == NULL);
}

cm_status cm_depth_make_maps(const cm_rays *rays, const float *image, unsigned threads,
                             const cm_depth_maps *maps)
{
    if (rays == NULL || image == NULL || maps == NULL || maps->size != sizeof *maps ||
        !are_maps(maps))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(maps->gap >= 0.0 && maps->gap <= 1e6))
    {
        return CM_ERROR_RANGE;
    }
    const size_t bands = cm_band_count(rays->pool, threads, rays->height, ROWS_AT_LEAST);
    mapping_rows m = {.rays = rays,
                      .image = image,
                      .maps = maps,
                      .gap = (float)(maps->gap == 0.0 ? GAP : maps->gap),
                      .is_range = maps->is_range && !rays->is_all_round,
                      .stride = cm_row_stride(rays->width)};
    cm_row_desk desk;
    if (!cm_row_desk_make(bands * DESK_ROWS * m.stride, &desk))
    {
        return CM_ERROR_MEMORY;
    }
    m.desk = desk.rows;
    cm_run_bands(rays->pool, bands, rays->height, ROWS_AT_LEAST,
                 maps->normal[0] != NULL ? map_band : vertex_band, &m);
    free(desk.memory);
    return CM_OK;
}
