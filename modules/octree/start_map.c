/* SPDX-License-Identifier: MIT */
#include "start_map.h"

#include <math.h>

/* Squares that a cube touches only by rounding are its, too. */
#define ROUNDING 1e-6

/* A cube is no farther divided if its edge is seen as so many squares or fewer. */
#define SMALL 2.0

typedef struct drawing
{
    const cm_snapshot *snapshot;
    const double *origin;
    double width;
    int coarsest;
    double far;
    cm_start_map *map;
} drawing;

static double larger(double a, double b)
{
    return a > b ? a : b;
}

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

/* How far a cube [low, low + size] from the origin is, and its farthest corner. */
static double nearest_of(const double low[3], double size, double *farthest)
{
    double near = 0.0, far = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        const double high = low[axis] + size;
        const double outside = low[axis] > 0.0 ? low[axis] : high < 0.0 ? high : 0.0;
        const double beyond = larger(fabs(low[axis]), fabs(high));
        near += outside * outside;
        far += beyond * beyond;
    }
    *farthest = sqrt(far);
    return sqrt(near);
}

/* The squares that [low, high] falls on, seen from ahead [near, far] > 0. */
static int squares_of(double low, double high, double near, double far, int *first, int *last)
{
    const double least = low < 0.0 ? low / near : low / far;
    const double most = high < 0.0 ? high / far : high / near;
    if (least > 1.0 + ROUNDING || most < -1.0 - ROUNDING)
    {
        return 0;
    }
    const double half = CM_START_EDGE / 2.0;
    const double a = (larger(least, -1.0) + 1.0 - ROUNDING) * half;
    const double b = (smaller(most, 1.0) + 1.0 + ROUNDING) * half;
    *first = a > 0.0 ? (int)a : 0;
    *last = b < CM_START_EDGE - 1 ? (int)b : CM_START_EDGE - 1;
    return 1;
}

static void draw_face(cm_start_map *map, int face, const double low[3], double size, float begin,
                      float end)
{
    const int axis = face / 2;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double near = face % 2 == 0 ? low[axis] : -(low[axis] + size);
    int first[2], last[2];
    const double ahead = larger(near, 1e-6 * size);
    if (near + size <= 0.0 ||
        !squares_of(low[u], low[u] + size, ahead, near + size, &first[0], &last[0]) ||
        !squares_of(low[v], low[v] + size, ahead, near + size, &first[1], &last[1]))
    {
        return;
    }
    for (int row = first[1]; row <= last[1]; row++)
    {
        for (int column = first[0]; column <= last[0]; column++)
        {
            float *b = &map->begin[face][row][column];
            float *e = &map->end[face][row][column];
            *b = begin < *b ? begin : *b;
            *e = end > *e ? end : *e;
        }
    }
}

/* A cube of 2^level voxels at a place, or the one around it that cones see there as a cell. */
static void draw_cube(const drawing *d, const uint32_t place[3], int level, double near)
{
    level = level > d->coarsest ? level : d->coarsest;
    double size = cm_size_of_level(level);
    for (; size < near * d->width; size *= 2.0)
    {
    }
    double low[3], far;
    for (int axis = 0; axis < 3; axis++)
    {
        low[axis] = floor(place[axis] / size) * size - d->origin[axis];
    }
    /* a voxel of it may begin there: what is rounded is behind */
    const double begin = nearest_of(low, size, &far) - 0.5;
    for (int face = 0; face < 6; face++)
    {
        draw_face(d->map, face, low, size, (float)begin, (float)(far + 0.5));
    }
}

static void draw_node(const drawing *d, int stage, const cm_seen_node *node,
                      const uint32_t place[3])
{
    const int level = 3 * stage;
    for (unsigned child = 0; child < 512; child++)
    {
        if ((node->mask[child / 64] >> child % 64 & 1) == 0)
        {
            continue;
        }
        uint32_t at[3];
        double low[3], far;
        for (unsigned axis = 0; axis < 3; axis++)
        {
            const unsigned k = child >> axis;
            at[axis] = place[axis] + (((k & 1) | (k >> 2 & 2) | (k >> 4 & 4)) << level);
            low[axis] = at[axis] - d->origin[axis];
        }
        const double size = cm_size_of_level(level);
        const double near = nearest_of(low, size, &far);
        if (near > d->far)
        {
            continue;
        }
        if (stage == 1 || size * CM_START_EDGE < SMALL * 2.0 * near)
        {
            draw_cube(d, at, level, near);
            continue;
        }
        const uint32_t below = d->snapshot->children[node->child + child];
        draw_node(d, stage - 1, &d->snapshot->node[stage - 1][below], at);
    }
}

void cm_start_map_make(const cm_snapshot *snapshot, const double origin[3], double width,
                       int coarsest, double far, cm_start_map *map)
{
    float *begin = &map->begin[0][0][0];
    float *end = &map->end[0][0][0];
    for (size_t i = 0; i < sizeof map->begin / sizeof *begin; i++)
    {
        begin[i] = INFINITY;
        end[i] = 0.0f;
    }
    if (snapshot->top >= 0)
    {
        const drawing d = {snapshot, origin, width, coarsest, far, map};
        const uint32_t corner[3] = {0, 0, 0};
        draw_node(&d, snapshot->top, snapshot->node[snapshot->top], corner);
    }
}

int cm_start_map_shorten(const cm_start_map *map, cm_cone *cone)
{
    const double *d = cone->direction;
    const double size[3] = {fabs(d[0]), fabs(d[1]), fabs(d[2])};
    const int axis = size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : size[1] >= size[2] ? 1 : 2;
    const int face = 2 * axis + (d[axis] < 0.0);
    const double scale = CM_START_EDGE / 2.0 / size[axis];
    const int column = (int)(d[(axis + 1) % 3] * scale + CM_START_EDGE / 2.0);
    const int row = (int)(d[(axis + 2) % 3] * scale + CM_START_EDGE / 2.0);
    const int c = column < CM_START_EDGE ? column : CM_START_EDGE - 1;
    const int r = row < CM_START_EDGE ? row : CM_START_EDGE - 1;
    cone->begin = larger(cone->begin, (double)map->begin[face][r][c]);
    cone->end = smaller(cone->end, (double)map->end[face][r][c]);
    return cone->begin < cone->end;
}
