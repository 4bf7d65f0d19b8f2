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

/* The parts of 27 cells that are occupied: cells beside the snapshot are empty. */
static void read_parts(const cm_snapshot *snapshot, cm_cone_path *path, const int32_t first[3],
                       int level, float part[27])
{
    const int64_t size = (int64_t)1 << (3 * snapshot->top + 3);
    for (int i = 0; i < 27; i++)
    {
        const int64_t at[3] = {(int64_t)(first[0] + i % 3) * ((int64_t)1 << level),
                               (int64_t)(first[1] + i / 3 % 3) * ((int64_t)1 << level),
                               (int64_t)(first[2] + i / 9) * ((int64_t)1 << level)};
        part[i] = 0.0f;
        if (at[0] >= 0 && at[1] >= 0 && at[2] >= 0 && at[0] < size && at[1] < size && at[2] < size)
        {
            const uint32_t place[3] = {(uint32_t)at[0], (uint32_t)at[1], (uint32_t)at[2]};
            const cm_cone_cell met = cm_cone_look(snapshot, path, place, level);
            part[i] = met.cell == NULL ? 0.0f : met.cell->part;
        }
    }
}

/* The gradient at a place, in cells of a level; turn: whose window is taken. */
static void gradient_at(const cm_snapshot *snapshot, cm_cone_path *path, cm_light_windows *windows,
                        int turn, const double place[3], int level, double gradient[3])
{
    double weight[3][3], slope[3][3];
    int32_t first[3];
    for (int axis = 0; axis < 3; axis++)
    {
        const double at = place[axis] / cm_size_of_level(level), low = floor(at);
        first[axis] = (int32_t)low - 1;
        spline_at(at - low, weight[axis], slope[axis]);
        gradient[axis] = 0.0;
    }
    if (windows->window[turn].level != level ||
        memcmp(windows->window[turn].first, first, sizeof first) != 0)
    {
        read_parts(snapshot, path, first, level, windows->window[turn].part);
        memcpy(windows->window[turn].first, first, sizeof first);
        windows->window[turn].level = level;
    }
    const float *part = windows->window[turn].part;
    for (int i = 0; i < 9; i++, part += 3)
    {
        const double *w = weight[0], *d = slope[0];
        const double along = part[0] * w[0] + part[1] * w[1] + part[2] * w[2];
        const double change = part[0] * d[0] + part[1] * d[1] + part[2] * d[2];
        const int y = i % 3, z = i / 3;
        gradient[0] += change * weight[1][y] * weight[2][z];
        gradient[1] += along * slope[1][y] * weight[2][z];
        gradient[2] += along * weight[1][y] * slope[2][z];
    }
}

void cm_light_normal(const cm_snapshot *snapshot, cm_cone_path *path, cm_light_windows *windows,
                     const double place[3], const double direction[3], int level, double normal[3])
{
    const double ahead = AHEAD_OF_SURFACE * cm_size_of_level(level + 1);
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
        gradient_at(snapshot, path, windows, turn, front, level + 1, gradient);
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
                    .begin = cm_size_of_level(level),
                    .coarsest = level > light->coarsest ? level : light->coarsest};
    double squared = 0.0, cosine = 0.0;
    for (int axis = 0; axis < 3; axis++)
    {
        cone.origin[axis] =
            place[axis] +
            (normal == NULL ? 0.0 : OUT_OF_SURFACE * cm_size_of_level(level) * normal[axis]);
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
