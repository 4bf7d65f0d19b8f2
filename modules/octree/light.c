/* SPDX-License-Identifier: MIT */
#include "light.h"

#include <math.h>
#include <string.h>

/* How far in front of a surface the gradient is taken and shadows begin, in cells. */
#define AHEAD_OF_SURFACE 0.75
#define OUT_OF_SURFACE 2.0

/* Quadratic B-spline over three cells and its derivative, at a place within the middle one. */
static void spline_at(double u, double weight[3], double slope[3])
{
    weight[0] = 0.5 * (1.0 - u) * (1.0 - u);
    weight[1] = 0.75 - (u - 0.5) * (u - 0.5);
    weight[2] = 0.5 * u * u;
    slope[0] = u - 1.0;
    slope[1] = 1.0 - 2.0 * u;
    slope[2] = u;
}

/* The part of a cell that is occupied: cells beside the snapshot are empty. */
static double part_of(const cm_snapshot *snapshot, cm_cone_path *path, const double cell[3],
                      int level)
{
    const double size = (double)((uint32_t)1 << (3 * snapshot->top + 3));
    uint32_t place[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const double at = ldexp(cell[axis], level);
        if (!(at >= 0.0 && at < size))
        {
            return 0.0;
        }
        place[axis] = (uint32_t)at;
    }
    const cm_cone_cell met = cm_cone_look(snapshot, path, place, level);
    return met.cell == NULL ? 0.0 : met.cell->part;
}

/* The gradient at a place, in cells of a level. */
static void gradient_at(const cm_snapshot *snapshot, cm_cone_path *path, const double place[3],
                        int level, double gradient[3])
{
    double weight[3][3], slope[3][3], first[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const double at = ldexp(place[axis], -level);
        first[axis] = floor(at) - 1.0;
        spline_at(at - floor(at), weight[axis], slope[axis]);
        gradient[axis] = 0.0;
    }
    for (int i = 0; i < 27; i++)
    {
        const int x = i % 3, y = i / 3 % 3, z = i / 9;
        const double cell[3] = {first[0] + x, first[1] + y, first[2] + z};
        const double part = part_of(snapshot, path, cell, level);
        gradient[0] += part * slope[0][x] * weight[1][y] * weight[2][z];
        gradient[1] += part * weight[0][x] * slope[1][y] * weight[2][z];
        gradient[2] += part * weight[0][x] * weight[1][y] * slope[2][z];
    }
}

void cm_light_normal(const cm_snapshot *snapshot, cm_cone_path *path, const double place[3],
                     const double direction[3], int level, double normal[3])
{
    const double ahead = ldexp(AHEAD_OF_SURFACE, level + 1);
    for (int axis = 0; axis < 3; axis++)
    {
        normal[axis] = -direction[axis];
    }
    /* in front of the surface by the way to the viewer, and then by the normal that is found there */
    for (int turn = 0; turn < 2; turn++)
    {
        double front[3], gradient[3];
        for (int axis = 0; axis < 3; axis++)
        {
            front[axis] = place[axis] + ahead * normal[axis];
        }
        gradient_at(snapshot, path, front, level + 1, gradient);
        const double length =
            sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2]);
        const double towards =
            gradient[0] * direction[0] + gradient[1] * direction[1] + gradient[2] * direction[2];
        for (int axis = 0; axis < 3 && length > 0.0; axis++)
        {
            normal[axis] = (towards < 0.0 ? gradient[axis] : -gradient[axis]) / length;
        }
    }
}

double cm_light_at(const cm_light *light, const cm_snapshot *snapshot, cm_cone_path *path,
                   const double place[3], const double normal[3], int level)
{
    cm_cone cone = {.width = light->width,
                    .begin = ldexp(1.0, level),
                    .coarsest = level > light->coarsest ? level : light->coarsest};
    double squared = 0.0, cosine = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        cone.origin[axis] =
            place[axis] + (normal == NULL ? 0.0 : ldexp(OUT_OF_SURFACE, level) * normal[axis]);
        cone.direction[axis] = light->place[axis] - cone.origin[axis];
        squared += cone.direction[axis] * cone.direction[axis];
    }
    cone.end = sqrt(squared);
    for (int axis = 0; axis < 3 && cone.end > 0.0; axis++)
    {
        cone.direction[axis] /= cone.end;
        cosine += normal == NULL ? 0.0 : normal[axis] * cone.direction[axis];
    }
    cosine = normal == NULL ? 1.0 : cosine;
    if (!(cosine > 0.0))
    {
        return light->ambient;
    }
    const double shadow =
        cone.end > cone.begin ? cm_cone_trace(snapshot, path, &cone).opacity : 0.0;
    return light->ambient + (1.0 - light->ambient) * cosine * (1.0 - shadow);
}
