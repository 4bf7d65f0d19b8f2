/* SPDX-License-Identifier: MIT
 *
 * A texel's outline is taken as the spherical polygon of its 4 corners, and of these with the middles of its 4 edges.
 * Neighbours share their edges, so both add up to the sphere; the error of the first, of edges that are no great
 * circles, is 4 times that of the second but for higher orders, and is extrapolated away. Large texels are sums of
 * smaller ones.
 */
#include "modules/memory/checked_size.h"
#include "environment_angles.h"

#include <cubemap/environment.h>

#include <math.h>
#include <stdlib.h>

#include "environment_pixels.h"
#include "image_jobs.h"

/* Texels are so small that a face has at least as many along its edge. */
#define FINE 64

uint8_t cm_angle_faces(const cm_mapping *mapping)
{
    return cm_mapping_describe(mapping)->family == CM_FAMILY_HYBRID ? 6 : 1;
}

typedef struct point
{
    double x;
    double y;
    double z;
} point;

/* tan of half the solid angle of a triangle is numerator / denominator (van Oosterom and Strackee 1983). Angles add
 * up as complex numbers multiply. */
static void add_triangle(point a, point b, point c, double *real, double *imaginary)
{
    const point p = {b.x - a.x, b.y - a.y, b.z - a.z};
    const point q = {c.x - a.x, c.y - a.y, c.z - a.z};
    const double numerator = a.x * (p.y * q.z - p.z * q.y) + a.y * (p.z * q.x - p.x * q.z) +
                             a.z * (p.x * q.y - p.y * q.x);
    const double denominator = 1.0 + (a.x * b.x + a.y * b.y + a.z * b.z) +
                               (b.x * c.x + b.y * c.y + b.z * c.z) +
                               (c.x * a.x + c.y * a.y + c.z * a.z);
    const double r = *real * denominator - *imaginary * numerator;
    *imaginary = *real * numerator + *imaginary * denominator;
    *real = r;
}

static double polygon_angle(const point *corner, size_t count)
{
    double real = 1.0;
    double imaginary = 0.0;
    for (size_t i = 2; i < count; i++)
    {
        add_triangle(corner[0], corner[i - 1], corner[i], &real, &imaginary);
    }
    return fabs(2.0 * atan2(imaginary, real));
}

/* Column i of three lines, of v low, middle and high, whose points are half a texel apart. */
static double texel_angle(const point *low, const point *middle, const point *high, size_t i)
{
    const point corners[4] = {low[2 * i], low[2 * i + 2], high[2 * i + 2], high[2 * i]};
    const point outline[8] = {low[2 * i],      low[2 * i + 1],  low[2 * i + 2], middle[2 * i + 2],
                              high[2 * i + 2], high[2 * i + 1], high[2 * i],    middle[2 * i]};
    return (4.0 * polygon_angle(outline, 8) - polygon_angle(corners, 4)) / 3.0;
}

/* All lines of a face. */
typedef struct angle_job
{
    const cm_mapping *mapping;
    uint8_t face;
    uint32_t size;  /* of the face, in texels */
    uint32_t parts; /* of a texel's edge */
    size_t bands;
    point *lines; /* three for each band of rows */
    double *angle;
} angle_job;

/* The points with v = 2 line / (2 m) - 1 of a face with m fine texels along the edge. */
static void make_line(const angle_job *job, size_t line, point *to)
{
    enum
    {
        SOME = 128
    };
    const size_t m = (size_t)job->size * job->parts;
    uint8_t face[SOME];
    double u[SOME];
    double v[SOME];
    double x[SOME];
    double y[SOME];
    double z[SOME];
    for (size_t first = 0; first <= 2 * m; first += SOME)
    {
        const size_t some = 2 * m + 1 - first < SOME ? 2 * m + 1 - first : SOME;
        for (size_t i = 0; i < some; i++)
        {
            face[i] = job->face;
            u[i] = (double)(first + i) / (double)m - 1.0;
            v[i] = (double)line / (double)m - 1.0;
        }
        cm_inverse_array(job->mapping, some, face, u, v, x, y, z);
        for (size_t i = 0; i < some; i++)
        {
            to[first + i] = (point){x[i], y[i], z[i]};
        }
    }
}

/* lines has room for three. */
static void add_row(const angle_job *job, size_t row, point *lines)
{
    const size_t m = (size_t)job->size * job->parts;
    const size_t length = 2 * m + 1;
    point *low = lines;
    point *middle = low + length;
    point *high = middle + length;
    double *angle = job->angle + row * job->size;
    for (size_t i = 0; i < job->size; i++)
    {
        angle[i] = 0.0;
    }
    for (size_t part = 0; part < job->parts; part++)
    {
        const size_t line = 2 * (row * job->parts + part);
        make_line(job, line, low);
        make_line(job, line + 1, middle);
        make_line(job, line + 2, high);
        for (size_t i = 0; i < m; i++)
        {
            angle[i / job->parts] += texel_angle(low, middle, high, i);
        }
    }
}

/* Rows band, band + bands, band + 2 bands..., with the lines of the band. */
static void add_band(size_t band, void *user)
{
    const angle_job *job = user;
    const size_t length = 2 * (size_t)job->size * job->parts + 1;
    for (size_t row = band; row < job->size; row += job->bands)
    {
        add_row(job, row, job->lines + band * 3 * length);
    }
}

cm_status cm_face_angles(const cm_mapping *mapping, uint8_t face, uint32_t size, unsigned threads,
                         double *angle)
{
    enum
    {
        BANDS = 64
    };
    const uint32_t parts = size >= FINE ? 1 : (FINE + size - 1) / size;
    const size_t length = 2 * (size_t)size * parts + 1;
    const size_t bands = size < BANDS ? size : BANDS;
    point *lines = cm_array_of(bands * 3 * length, sizeof *lines);
    if (lines == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    angle_job job = {mapping, face, size, parts, bands, lines, angle};
    cm_run_pieces(threads, bands, add_band, &job);
    free(lines);
    return CM_OK;
}

cm_status cm_angle_edges_make(const cm_mapping *mapping, uint32_t size, unsigned threads,
                              float **edge)
{
    const size_t count = (size_t)CM_DENSITY_SIZE * CM_DENSITY_SIZE;
    const uint8_t faces = cm_angle_faces(mapping);
    float *made = cm_array_of(faces * count, sizeof *made);
    double *angle = cm_array_of(count, sizeof *angle);
    cm_status status = made != NULL && angle != NULL ? CM_OK : CM_ERROR_MEMORY;
    for (uint8_t face = 0; face < faces && status == CM_OK; face++)
    {
        status = cm_face_angles(mapping, face, CM_DENSITY_SIZE, threads, angle);
        for (size_t i = 0; i < count && status == CM_OK; i++)
        {
            made[face * count + i] = (float)log2(sqrt(angle[i]) * CM_DENSITY_SIZE / size);
        }
    }
    free(angle);
    if (status != CM_OK)
    {
        free(made);
        return status;
    }
    *edge = made;
    return CM_OK;
}

cm_status cm_texel_solid_angles(const cm_mapping *mapping, uint8_t face, uint32_t size,
                                double *angle)
{
    if (mapping == NULL || angle == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cm_mapping_describe(mapping)->kind != CM_KIND_CUBE)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    if (face > 5 || size < 1 || size > CM_ENVIRONMENT_SIZE_MAX)
    {
        return CM_ERROR_RANGE;
    }
    const cm_status status = cm_face_angles(mapping, face, size, 1, angle);
    if (status != CM_OK || cm_mapping_frame(mapping)->first_row_v < 0)
    {
        return status;
    }
    for (size_t row = 0; row < size / 2; row++)
    {
        for (size_t column = 0; column < size; column++)
        {
            const size_t other = (size - 1 - row) * size + column;
            const double above = angle[row * size + column];
            angle[row * size + column] = angle[other];
            angle[other] = above;
        }
    }
    return CM_OK;
}
