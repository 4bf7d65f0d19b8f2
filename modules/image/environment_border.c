/* SPDX-License-Identifier: MIT
 *
 * The texels beyond the edges of a face: the neighbour's, at the place that mirrors the face's own outermost texel in
 * the edge. Where neighbours are mirror images, as on the cube, that is the adjoining texel, and interpolation is
 * continuous across the edge.
 */
#include <math.h>

#include "environment_levels.h"

/* So many texels of an edge at once. */
#define SOME 128

typedef struct directions
{
    double x[SOME];
    double y[SOME];
    double z[SOME];
} directions;

/* The directions of points of an edge, so far from the middle of the face across and moved so far along. edge 0 to 3:
 * u = -1, u = 1, v = -1, v = 1. */
static void points_of_edge(const cm_mapping *mapping, uint32_t size, size_t face, size_t edge,
                           size_t first, size_t some, double across, double moved, directions *to)
{
    uint8_t faces[SOME];
    double u[SOME];
    double v[SOME];
    for (size_t i = 0; i < some; i++)
    {
        const double along = (2.0 * (double)(first + i) + 1.0) / size - 1.0 + moved;
        const double away = edge % 2 == 0 ? -across : across;
        faces[i] = (uint8_t)face;
        u[i] = edge < 2 ? away : along;
        v[i] = edge < 2 ? along : away;
    }
    cm_inverse_array(mapping, some, faces, u, v, to->x, to->y, to->z);
}

/* Mirrors point i in the plane through the centre, a and b. */
static void mirror(const directions *a, const directions *b, size_t i, directions *point)
{
    const double dx = b->x[i] - a->x[i];
    const double dy = b->y[i] - a->y[i];
    const double dz = b->z[i] - a->z[i];
    const double nx = a->y[i] * dz - a->z[i] * dy;
    const double ny = a->z[i] * dx - a->x[i] * dz;
    const double nz = a->x[i] * dy - a->y[i] * dx;
    const double along = 2.0 * (nx * point->x[i] + ny * point->y[i] + nz * point->z[i]) /
                         (nx * nx + ny * ny + nz * nz);
    point->x[i] -= along * nx;
    point->y[i] -= along * ny;
    point->z[i] -= along * nz;
}

/* Bilinear between the texels of one face, whose outermost go on beyond its edges. */
static void take(const cm_level *level, size_t face, double u, double v, float *to)
{
    const double last = level->size - 1.0;
    const double column = fmin(fmax((u + 1.0) / 2.0 * level->size - 0.5, 0.0), last);
    const double row = fmin(fmax((v + 1.0) / 2.0 * level->size - 0.5, 0.0), last);
    const ptrdiff_t i = (ptrdiff_t)fmin(floor(column), fmax(last - 1.0, 0.0));
    const ptrdiff_t j = (ptrdiff_t)fmin(floor(row), fmax(last - 1.0, 0.0));
    const ptrdiff_t next = last > 0.0 ? 1 : 0;
    const float right = (float)(column - (double)i);
    const float up = (float)(row - (double)j);
    const float *a = cm_level_texel(level, face, j, i);
    const float *b = cm_level_texel(level, face, j, i + next);
    const float *c = cm_level_texel(level, face, j + next, i);
    const float *d = cm_level_texel(level, face, j + next, i + next);
    for (size_t k = 0; k < CM_TEXEL; k++)
    {
        const float low = a[k] + right * (b[k] - a[k]);
        const float high = c[k] + right * (d[k] - c[k]);
        to[k] = low + up * (high - low);
    }
}

static void fill_edge(const cm_mapping *mapping, const cm_level *level, size_t face, size_t edge)
{
    const uint32_t size = level->size;
    const double quarter = 0.5 / size;
    directions inside, before, behind;
    uint8_t faces[SOME];
    double u[SOME];
    double v[SOME];
    for (size_t first = 0; first < size; first += SOME)
    {
        const size_t some = size - first < SOME ? size - first : SOME;
        points_of_edge(mapping, size, face, edge, first, some, 1.0 - 1.0 / size, 0.0, &inside);
        points_of_edge(mapping, size, face, edge, first, some, 1.0, -quarter, &before);
        points_of_edge(mapping, size, face, edge, first, some, 1.0, quarter, &behind);
        for (size_t i = 0; i < some; i++)
        {
            mirror(&before, &behind, i, &inside);
        }
        cm_forward_array(mapping, some, inside.x, inside.y, inside.z, faces, u, v);
        for (size_t i = 0; i < some; i++)
        {
            const ptrdiff_t along = (ptrdiff_t)(first + i);
            const ptrdiff_t away = edge % 2 == 0 ? -1 : (ptrdiff_t)size;
            take(level, faces[i], u[i], v[i],
                 edge < 2 ? cm_level_texel(level, face, along, away)
                          : cm_level_texel(level, face, away, along));
        }
    }
}

/* Three texels meet at a corner of the cube: the fourth is their mean, so that all three faces have that mean there. */
static void fill_corners(const cm_level *level, size_t face)
{
    const ptrdiff_t end = (ptrdiff_t)level->size;
    for (size_t corner = 0; corner < 4; corner++)
    {
        const ptrdiff_t row = corner < 2 ? 0 : end - 1;
        const ptrdiff_t column = corner % 2 == 0 ? 0 : end - 1;
        const ptrdiff_t above = corner < 2 ? -1 : end;
        const ptrdiff_t beside = corner % 2 == 0 ? -1 : end;
        const float *a = cm_level_texel(level, face, row, column);
        const float *b = cm_level_texel(level, face, above, column);
        const float *c = cm_level_texel(level, face, row, beside);
        float *to = cm_level_texel(level, face, above, beside);
        for (size_t k = 0; k < CM_TEXEL; k++)
        {
            to[k] = (a[k] + b[k] + c[k]) * (1.0F / 3.0F);
        }
    }
}

void cm_level_fill_border(const cm_mapping *mapping, const cm_level *level)
{
    for (size_t face = 0; face < 6; face++)
    {
        for (size_t edge = 0; edge < 4; edge++)
        {
            fill_edge(mapping, level, face, edge);
        }
        fill_corners(level, face);
    }
}
