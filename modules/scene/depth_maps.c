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
    cm_run_bands(cm_band_count(threads, rays->height, ROWS_AT_LEAST), rays->height, ROWS_AT_LEAST,
                 range_band, &r);
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

/* Rows that a band needs of its neighbours, whose rows are written by them, and depths of ranges. */
enum
{
    DESK_ROWS = 7
};

typedef struct mapping_rows
{
    const cm_rays *rays;
    const float *image;
    const cm_depth_maps *maps;
    float gap;
    int is_range; /* and the camera has depths */
    float *desk;  /* DESK_ROWS of each band */
} mapping_rows;

static void vertices_of(const mapping_rows *m, size_t row, float *depths, float *const vertex[3])
{
    const cm_ray_row ray = cm_ray_row_at(m->rays, row);
    const float *values = m->image + row * m->rays->width;
    if (m->is_range)
    {
        m->rays->set->from_range(m->rays->width, &ray, values, depths);
        values = depths;
    }
    m->rays->set->vertices(m->rays->width, &ray, values, vertex);
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

/* Row -1, 0 or 1 from one of a band: its own, or one of the desk. */
static void take_row(const mapping_rows *m, size_t row, int beside, size_t first, size_t last,
                     float *desk, cm_normal_rows *rows)
{
    const size_t width = m->rays->width;
    const size_t faces = m->rays->face_rows;
    const size_t wanted = row + (size_t)beside;
    rows->image[1 + beside] = NULL;
    if ((beside < 0 && row % faces == 0) || (beside > 0 && (row + 1) % faces == 0))
    {
        return;
    }
    rows->image[1 + beside] = m->image + wanted * width;
    for (size_t k = 0; k < 3; k++)
    {
        rows->vertex[1 + beside][k] = wanted < first   ? desk + (1 + k) * width
                                      : wanted >= last ? desk + (4 + k) * width
                                                       : m->maps->vertex[k] + wanted * width;
    }
}

static void normals_of(const mapping_rows *m, size_t row, size_t first, size_t last, float *desk)
{
    cm_normal_rows rows = {.gap = m->gap};
    float *normal[3];
    for (int beside = -1; beside <= 1; beside++)
    {
        take_row(m, row, beside, first, last, desk, &rows);
    }
    point_to_row(m->maps->normal, m->rays->width, row, normal);
    m->rays->set->normals(m->rays->width, &rows, normal);
    if (m->maps->radius != NULL)
    {
        radii_of(m, row);
    }
}

/* Vertices one row ahead of normals, while they are in the cache. */
static void map_band(size_t first, size_t last, size_t band, void *user)
{
    const mapping_rows *m = user;
    const size_t width = m->rays->width;
    float *desk = m->desk + band * DESK_ROWS * width;
    float *beside[2][3] = {{desk + width, desk + 2 * width, desk + 3 * width},
                           {desk + 4 * width, desk + 5 * width, desk + 6 * width}};
    const int has_normals = m->maps->normal[0] != NULL;
    if (has_normals && first > 0)
    {
        vertices_of(m, first - 1, desk, beside[0]);
    }
    for (size_t row = first; row < last; row++)
    {
        float *vertex[3];
        point_to_row(m->maps->vertex, width, row, vertex);
        vertices_of(m, row, desk, vertex);
        if (has_normals && row > first)
        {
            normals_of(m, row - 1, first, last, desk);
        }
    }
    if (has_normals && last < m->rays->height)
    {
        vertices_of(m, last, desk, beside[1]);
    }
    if (has_normals)
    {
        normals_of(m, last - 1, first, last, desk);
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
    const size_t bands = cm_band_count(threads, rays->height, ROWS_AT_LEAST);
    mapping_rows m = {.rays = rays,
                      .image = image,
                      .maps = maps,
                      .gap = (float)(maps->gap == 0.0 ? GAP : maps->gap),
                      .is_range = maps->is_range && !rays->is_all_round,
                      .desk = malloc(bands * DESK_ROWS * rays->width * sizeof *m.desk)};
    if (m.desk == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    cm_run_bands(bands, rays->height, ROWS_AT_LEAST, map_band, &m);
    free(m.desk);
    return CM_OK;
}
