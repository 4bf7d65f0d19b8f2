/* SPDX-License-Identifier: MIT
 *
 * Triangles: three planes through the camera's centre.
 */
#include "raster_object.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "bands.h"
#include "exact_side.h"

#define COORDINATE_MOST 1e100

/* Coordinates are 0 below this part of the largest: exact_side.h. */
#define CORNER_LEAST 0x1p-200

/* Rounding of a sum of three products with differences of two is below six halves of an ulp of the sum of sizes. */
#define SLACK 0x1p-49

/* Boxes of more pixels are drawn by tiles. */
#define BOX_MOST 1024

typedef struct pixel_range
{
    size_t column, columns;
    size_t row, rows;
    int is_known;
} pixel_range;

static void cross(const double a[3], const double b[3], double to[3])
{
    to[0] = a[1] * b[2] - a[2] * b[1];
    to[1] = a[2] * b[0] - a[0] * b[2];
    to[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Not fmax and fmin, which are calls: here nothing is NaN. */
static double more_of(double a, double b)
{
    return a > b ? a : b;
}

static double less_of(double a, double b)
{
    return a < b ? a : b;
}

static double largest_of(const double v[3])
{
    return more_of(fabs(v[0]), more_of(fabs(v[1]), fabs(v[2])));
}

int cm_raster_take_corners(const cm_pose *pose, const cm_triangles *triangles, size_t which,
                           double corner[3][3])
{
    double sum = 0.0;
    for (size_t k = 0; k < 3; k++)
    {
        const size_t vertex =
            triangles->index == NULL ? 3 * which + k : triangles->index[3 * which + k];
        cm_raster_transform(pose, triangles->position + 3 * vertex, corner[k]);
        sum += fabs(corner[k][0]) + fabs(corner[k][1]) + fabs(corner[k][2]);
    }
    return sum < COORDINATE_MOST;
}

/* The power of two that brings a number from 2^-1022 to 1e100 to 1/2 and more, below 1. */
static double scale_of(double number)
{
    uint64_t bits;
    double scale;
    memcpy(&bits, &number, sizeof bits);
    const uint64_t exponent = bits >> 52;
    bits = (2 * (uint64_t)1023 - 1 - exponent) << 52;
    memcpy(&scale, &bits, sizeof scale);
    return scale;
}

/* A corner's direction, by its own numbers alone: the largest from 1/2 to 1. */
static int direction_of(const double corner[3], double to[3])
{
    const double most = largest_of(corner);
    if (!(most > 2.0 * DBL_MIN))
    {
        return 0;
    }
    const double scale = scale_of(most);
    for (int k = 0; k < 3; k++)
    {
        to[k] = corner[k] * scale;
        to[k] = fabs(to[k]) < CORNER_LEAST ? 0.0 : to[k];
    }
    return 1;
}

static void turn_over(double a[3], double b[3])
{
    for (int k = 0; k < 3; k++)
    {
        const double kept = a[k];
        a[k] = b[k];
        b[k] = kept;
    }
}

/* The plane, seen from the centre; the corners nearest to the mean make the differences. */
static int take_plane(const cm_raster *raster, double corner[3][3], cm_raster_triangle *shape)
{
    double across[3];
    double down[3];
    double normal[3];
    double middle[3];
    for (int k = 0; k < 3; k++)
    {
        across[k] = corner[1][k] - corner[0][k];
        down[k] = corner[2][k] - corner[0][k];
        middle[k] = (corner[0][k] + corner[1][k] + corner[2][k]) / 3.0;
    }
    const double size = more_of(largest_of(across), largest_of(down));
    if (!(size > 0.0))
    {
        return 0;
    }
    for (int k = 0; k < 3; k++)
    {
        across[k] /= size;
        down[k] /= size;
    }
    cross(across, down, normal);
    const double distance = dot(normal, middle);
    shape->least = 0.0;
    shape->most = DBL_MAX;
    for (int k = 0; k < 3; k++)
    {
        shape->plane[k] = normal[k] / distance;
        if (!(fabs(shape->plane[k]) <= DBL_MAX))
        {
            return 0;
        }
    }
    /* 1 / depth is that of a corner somewhere, and nowhere less or more */
    const double z[3] = {corner[0][2], corner[1][2], corner[2][2]};
    if (!raster->is_all_round && z[0] > 0.0 && z[1] > 0.0 && z[2] > 0.0)
    {
        shape->least = 1.0 / more_of(z[0], more_of(z[1], z[2]));
        shape->most = 1.0 / less_of(z[0], less_of(z[1], z[2]));
    }
    return 1;
}

static int make_triangle(const cm_raster *raster, double corner[3][3], cm_raster_triangle *shape)
{
    for (int k = 0; k < 3; k++)
    {
        if (!direction_of(corner[k], shape->corner[k]))
        {
            return 0;
        }
    }
    const double *a = shape->corner[0];
    double normal[3];
    cross(shape->corner[1], shape->corner[2], normal);
    double side = dot(a, normal);
    if (fabs(side) < 16.0 * SLACK)
    {
        side = cm_exact_side(a, shape->corner[1], shape->corner[2]);
    }
    if (side < 0.0)
    {
        turn_over(shape->corner[1], shape->corner[2]);
    }
    for (int k = 0; k < 3; k++)
    {
        const double *p = shape->corner[(k + 1) % 3];
        const double *q = shape->corner[(k + 2) % 3];
        cross(p, q, shape->edge[k]);
        const double sizes = fabs(p[1] * q[2]) + fabs(p[2] * q[1]) + fabs(p[2] * q[0]) +
                             fabs(p[0] * q[2]) + fabs(p[0] * q[1]) + fabs(p[1] * q[0]);
        shape->slack[k] = SLACK * sizes * raster->ray_most;
    }
    return take_plane(raster, corner, shape);
}

/* ---- where ---- */

static int meets(const void *user, const cm_tile_cone *cone)
{
    const cm_raster_triangle *shape = user;
    for (int k = 0; k < 3; k++)
    {
        const double *edge = shape->edge[k];
        const double size = sqrt(dot(edge, edge));
        if (dot(edge, cone->axis) < -size * cone->sine - shape->slack[k])
        {
            return 0;
        }
    }
    return 1;
}

static void draw_rows(cm_raster *raster, const cm_raster_triangle *shape, uint32_t id,
                      const pixel_range *range)
{
    for (size_t row = range->row; row < range->row + range->rows; row++)
    {
        const cm_raster_rays rays = cm_raster_rays_at(raster, range->column, row);
        const cm_raster_pixels pixels = cm_raster_pixels_at(raster, range->column, row, id);
        raster->set->triangle_row(range->columns, &rays, shape, &pixels);
    }
}

/* A triangle and its id. */
typedef struct named_triangle
{
    cm_raster_triangle shape; /* first: meets sees it */
    uint32_t id;
} named_triangle;

static void draw_tile(cm_raster *raster, const void *user, size_t column, size_t row,
                      size_t columns, size_t rows)
{
    const named_triangle *triangle = user;
    const pixel_range range = {column, columns, row, rows, 1};
    draw_rows(raster, &triangle->shape, triangle->id, &range);
}

/* Rounding moves places of pixels by less: by a part of a pixel, and of the numbers that they are the sum of. */
#define PIXEL_ROOM 1e-3
#define SUM_ROOM 1e-12

/* The pixels of an interval whose ends are sums of numbers up to `size`, within first to last - 1. */
static void clip(double least, double most, double size, size_t first, size_t last, size_t *begin,
                 size_t *count)
{
    const double room = PIXEL_ROOM + SUM_ROOM * size;
    const double low = more_of(least - room, (double)first);
    const double high = less_of(most + room, (double)last - 1.0);
    *begin = first;
    *count = 0;
    if (low <= high)
    {
        const size_t down = (size_t)low;
        *begin = (double)down < low ? down + 1 : down;
        *count = (size_t)high + 1 - *begin;
    }
}

/* The box of a triangle wholly in front of a plain camera. */
static pixel_range box_of(const cm_raster *raster, double corner[3][3], size_t first, size_t last)
{
    const cm_camera_options *options = cm_camera_describe(raster->camera);
    pixel_range range = {0};
    double least[2] = {DBL_MAX, DBL_MAX};
    double most[2] = {-DBL_MAX, -DBL_MAX};
    for (int k = 0; k < 3; k++)
    {
        const double *p = corner[k];
        if (!raster->is_plain || !(p[2] > 0.0))
        {
            return range;
        }
        const double column = options->fx * (p[0] / p[2]);
        const double row = options->fy * (p[1] / p[2]);
        least[0] = less_of(least[0], column);
        most[0] = more_of(most[0], column);
        least[1] = less_of(least[1], row);
        most[1] = more_of(most[1], row);
    }
    const double cx = options->cx - options->pixel_centre;
    const double cy = options->cy - options->pixel_centre;
    clip(least[0] + cx, most[0] + cx, more_of(fabs(least[0]), fabs(most[0])) + fabs(cx), 0,
         raster->width, &range.column, &range.columns);
    clip(least[1] + cy, most[1] + cy, more_of(fabs(least[1]), fabs(most[1])) + fabs(cy), first,
         last, &range.row, &range.rows);
    range.is_known = range.columns * range.rows <= BOX_MOST;
    return range;
}

/* ---- all ---- */

typedef struct drawing
{
    cm_raster *raster;
    const cm_pose *pose;
    const cm_triangles *triangles;
} drawing;

static void draw_band(size_t first, size_t last, size_t band, void *user)
{
    const drawing *d = user;
    (void)band;
    for (size_t i = 0; i < d->triangles->triangle_count; i++)
    {
        double corner[3][3];
        named_triangle triangle = {.id = d->triangles->first_id + (uint32_t)i};
        if (!cm_raster_take_corners(d->pose, d->triangles, i, corner))
        {
            continue;
        }
        const pixel_range range = box_of(d->raster, corner, first, last);
        if ((range.is_known && range.columns * range.rows == 0) ||
            !make_triangle(d->raster, corner, &triangle.shape))
        {
            continue;
        }
        if (range.is_known)
        {
            draw_rows(d->raster, &triangle.shape, triangle.id, &range);
        }
        else
        {
            cm_raster_visit(d->raster, &triangle, meets, draw_tile, first, last);
        }
    }
}

cm_status cm_raster_check_triangles(const cm_triangles *t)
{
    if (t == NULL || t->size != sizeof *t || (t->triangle_count > 0 && t->position == NULL) ||
        (t->index == NULL && t->triangle_count > t->vertex_count / 3))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cm_raster_check_ids(t->first_id, t->triangle_count) != CM_OK)
    {
        return CM_ERROR_RANGE;
    }
    for (size_t i = 0; t->index != NULL && i < 3 * t->triangle_count; i++)
    {
        if (t->index[i] >= t->vertex_count)
        {
            return CM_ERROR_ARGUMENT;
        }
    }
    return CM_OK;
}

cm_status cm_raster_triangles(cm_raster *raster, const cm_pose *pose, const cm_triangles *triangles,
                              unsigned threads)
{
    const cm_status status =
        raster == NULL ? CM_ERROR_ARGUMENT : cm_raster_check_triangles(triangles);
    if (status != CM_OK)
    {
        return status;
    }
    drawing d = {raster, pose, triangles};
    cm_run_bands(raster->pool, cm_band_count(raster->pool, threads, raster->height, CM_TILE),
                 raster->height, CM_TILE, draw_band, &d);
    return CM_OK;
}
