/* SPDX-License-Identifier: MIT */
#include "room_views.h"

#include <math.h>
#include <stdlib.h>

/* Beside a voxel's border is what is nearer than this, in edges. */
#define BESIDE 1e-6

enum
{
    COSINES = 31,
    DIRECTION_SHIFT = 5,
    GRAZING = 6 /* 0.2 of 31 */
};

int room_truth_make(const cm_scene *scene, double edge, const double centre[3],
                    const double least[3], const double greatest[3], room_truth *truth)
{
    *truth = (room_truth){.scene = scene, .edge = edge};
    size_t count = 1;
    for (int i = 0; i < 3; i++)
    {
        truth->centre[i] = centre[i];
        truth->least[i] = least[i];
        truth->greatest[i] = greatest[i];
        truth->first[i] = (int64_t)floor((least[i] - centre[i]) / edge) - 2;
        truth->count[i] =
            (size_t)((int64_t)ceil((greatest[i] - centre[i]) / edge) + 2 - truth->first[i]);
        count *= truth->count[i];
    }
    truth->seen = calloc(count, 1);
    return truth->seen != NULL;
}

void room_truth_free(room_truth *truth)
{
    free(truth->seen);
    *truth = (room_truth){0};
}

/* The voxel of a point; 0 if it is not of the grid. */
static int find_voxel(const room_truth *truth, const double point[3], int64_t voxel[3])
{
    for (int i = 0; i < 3; i++)
    {
        const double at = floor((point[i] - truth->centre[i]) / truth->edge);
        if (!(at >= (double)truth->first[i] &&
              at < (double)truth->first[i] + (double)truth->count[i]))
        {
            return 0;
        }
        voxel[i] = (int64_t)at;
    }
    return 1;
}

static size_t index_of(const room_truth *truth, const int64_t voxel[3])
{
    const size_t x = (size_t)(voxel[0] - truth->first[0]);
    const size_t y = (size_t)(voxel[1] - truth->first[1]);
    const size_t z = (size_t)(voxel[2] - truth->first[2]);
    return (z * truth->count[1] + y) * truth->count[0] + x;
}

static void centre_of(const room_truth *truth, const int64_t voxel[3], double centre[3])
{
    for (int i = 0; i < 3; i++)
    {
        centre[i] = truth->centre[i] + ((double)voxel[i] + 0.5) * truth->edge;
    }
}

/* 0: one voxel; 1 to 6: behind the surface is the next one along -x, +x, -y, ... */
static int direction_between(const int64_t front[3], const int64_t behind[3])
{
    for (int i = 0; i < 3; i++)
    {
        if (front[i] != behind[i])
        {
            return 1 + 2 * i + (behind[i] > front[i] ? 1 : 0);
        }
    }
    return 0;
}

void room_truth_see(room_truth *truth, const room_picture *picture)
{
    for (size_t i = 0; i < picture->pixels; i++)
    {
        double ahead[3], beyond[3];
        int64_t front[3], behind[3];
        for (int k = 0; k < 3; k++)
        {
            const double aside = BESIDE * truth->edge * picture->normal[k][i];
            ahead[k] = picture->point[k][i] + aside;
            beyond[k] = picture->point[k][i] - aside;
        }
        if (!find_voxel(truth, ahead, front) || !find_voxel(truth, beyond, behind))
        {
            continue;
        }
        unsigned char *seen = truth->seen + index_of(truth, front);
        const int cosine = 1 + (int)(fmin(fmax(picture->cosine[i], 0.0), 1.0) * (COSINES - 1));
        const int direction = direction_between(front, behind);
        const int best = *seen & COSINES;
        const int former = best == 0 ? direction : *seen >> DIRECTION_SHIFT;
        *seen = (unsigned char)((cosine > best ? cosine : best) |
                                (direction == 0 ? 0 : former << DIRECTION_SHIFT));
    }
}

/* ---- surfaces ---- */

/* Signed, of a solid along the axes: below 0 inside. */
static double box_distance(const double half[3], const double from_middle[3])
{
    double outside = 0.0;
    double inside = -INFINITY;
    for (int i = 0; i < 3; i++)
    {
        const double beyond = fabs(from_middle[i]) - half[i];
        outside += beyond > 0.0 ? beyond * beyond : 0.0;
        inside = fmax(inside, beyond);
    }
    return inside > 0.0 ? sqrt(outside) : inside;
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double cylinder_distance(const cm_primitive *p, const double point[3])
{
    double axis[3], from[3];
    double along = 0.0;
    for (int i = 0; i < 3; i++)
    {
        axis[i] = p->second[i] - p->first[i];
        from[i] = point[i] - 0.5 * (p->first[i] + p->second[i]);
    }
    const double length = length_of(axis);
    for (int i = 0; i < 3; i++)
    {
        along += axis[i] / length * from[i];
    }
    for (int i = 0; i < 3; i++)
    {
        from[i] -= along * axis[i] / length;
    }
    const double half[3] = {p->radius, 0.5 * length, 1.0};
    const double flat[3] = {length_of(from), along, 0.0};
    const double outside[2] = {fmax(flat[0] - half[0], 0.0), fmax(fabs(flat[1]) - half[1], 0.0)};
    const double inside = fmax(flat[0] - half[0], fabs(flat[1]) - half[1]);
    return inside > 0.0 ? hypot(outside[0], outside[1]) : inside;
}

static double distance_to(const cm_primitive *p, const double point[3])
{
    double from[3], half[3];
    double along = 0.0;
    for (int i = 0; i < 3; i++)
    {
        from[i] = point[i] - p->first[i];
        along += from[i] * p->second[i];
    }
    switch (p->kind)
    {
    case CM_PRIMITIVE_PLANE:
        return fabs(along);
    case CM_PRIMITIVE_SPHERE:
        return fabs(length_of(from) - p->radius);
    case CM_PRIMITIVE_CYLINDER:
        return fabs(cylinder_distance(p, point));
    default:
        for (int i = 0; i < 3; i++)
        {
            from[i] = point[i] - 0.5 * (p->first[i] + p->second[i]);
            half[i] = 0.5 * (p->second[i] - p->first[i]);
        }
        return fabs(box_distance(half, from));
    }
}

double room_truth_distance(const room_truth *truth, const double point[3])
{
    double nearest = INFINITY;
    for (size_t i = 0; i < cm_scene_count(truth->scene); i++)
    {
        nearest = fmin(nearest, distance_to(cm_scene_at(truth->scene, (uint32_t)i), point));
    }
    return nearest;
}

/* ---- crossed voxels ---- */

/* The least and the greatest distance of points of a cube from a point, in the first axes. */
static void distances(const double point[3], const double low[3], const double high[3], int axes,
                      double *least, double *greatest)
{
    double nearest = 0.0;
    double farthest = 0.0;
    for (int i = 0; i < axes; i++)
    {
        const double off = fmax(fmax(low[i] - point[i], point[i] - high[i]), 0.0);
        const double far_off = fmax(fabs(point[i] - low[i]), fabs(point[i] - high[i]));
        nearest += off * off;
        farthest += far_off * far_off;
    }
    *least = sqrt(nearest);
    *greatest = sqrt(farthest);
}

/* Has the surface points inside of the cube? Cylinders stand along z, or lie in a box for others. */
static int crosses(const cm_primitive *p, const double low[3], const double high[3])
{
    double least, greatest;
    double towards = 0.0;
    double reach = 0.0;
    int overlaps = 1;
    int inside = 1;
    switch (p->kind)
    {
    case CM_PRIMITIVE_PLANE:
        for (int i = 0; i < 3; i++)
        {
            towards += (0.5 * (low[i] + high[i]) - p->first[i]) * p->second[i];
            reach += 0.5 * (high[i] - low[i]) * fabs(p->second[i]);
        }
        return fabs(towards) < reach;
    case CM_PRIMITIVE_SPHERE:
        distances(p->first, low, high, 3, &least, &greatest);
        return least < p->radius && greatest > p->radius;
    case CM_PRIMITIVE_CYLINDER:
        distances(p->first, low, high, 2, &least, &greatest);
        overlaps = least < p->radius && low[2] < p->second[2] && high[2] > p->first[2];
        inside = greatest <= p->radius && low[2] >= p->first[2] && high[2] <= p->second[2];
        return overlaps && !inside;
    default:
        for (int i = 0; i < 3; i++)
        {
            overlaps = overlaps && low[i] < p->second[i] && high[i] > p->first[i];
            inside = inside && low[i] >= p->first[i] && high[i] <= p->second[i];
        }
        return overlaps && !inside;
    }
}

/* A voxel's sides are moved in, so that what lies on them does not cross it. */
static int is_crossed(const room_truth *truth, const int64_t corner[3], int64_t length)
{
    double low[3], high[3];
    for (int i = 0; i < 3; i++)
    {
        low[i] = truth->centre[i] + ((double)corner[i] + BESIDE) * truth->edge;
        high[i] = truth->centre[i] + ((double)(corner[i] + length) - BESIDE) * truth->edge;
        if (low[i] >= truth->greatest[i] || high[i] <= truth->least[i])
        {
            return 0;
        }
    }
    for (size_t i = 0; i < cm_scene_count(truth->scene); i++)
    {
        if (crosses(cm_scene_at(truth->scene, (uint32_t)i), low, high))
        {
            return 1;
        }
    }
    return 0;
}

int room_truth_crossed(const room_truth *truth, const double point[3])
{
    int64_t voxel[3];
    return find_voxel(truth, point, voxel) && is_crossed(truth, voxel, 1);
}

static void judge_crossed(const room_truth *truth, const int64_t corner[3], int64_t length,
                          const void *map, room_state state, room_errors *errors)
{
    if (!is_crossed(truth, corner, length))
    {
        return;
    }
    if (length == 1)
    {
        double centre[3];
        centre_of(truth, corner, centre);
        errors->crossed++;
        errors->crossed_free += state(map, centre) == 1 ? 1 : 0;
        return;
    }
    for (int child = 0; child < 8; child++)
    {
        const int64_t half = length / 2;
        const int64_t of_child[3] = {corner[0] + (child & 1 ? half : 0),
                                     corner[1] + (child & 2 ? half : 0),
                                     corner[2] + (child & 4 ? half : 0)};
        judge_crossed(truth, of_child, half, map, state, errors);
    }
}

static void judge_visible(const room_truth *truth, const int64_t voxel[3], const void *map,
                          room_state state, room_errors *errors)
{
    const int seen = truth->seen[index_of(truth, voxel)];
    if (seen == 0)
    {
        return;
    }
    const int direction = seen >> DIRECTION_SHIFT;
    double centre[3];
    centre_of(truth, voxel, centre);
    int is = state(map, centre);
    if (direction != 0)
    {
        centre[(direction - 1) / 2] += (direction - 1) % 2 == 0 ? -truth->edge : truth->edge;
        const int behind = state(map, centre);
        is = behind > is ? behind : is;
    }
    const int is_grazing = (seen & COSINES) <= GRAZING;
    errors->visible++;
    errors->visible_occupied += is == 2 ? 1 : 0;
    errors->visible_free += is == 1 ? 1 : 0;
    errors->grazing += is_grazing ? 1 : 0;
    errors->grazing_occupied += is_grazing && is == 2 ? 1 : 0;
}

void room_truth_judge(const room_truth *truth, const void *map, room_state state,
                      room_errors *errors)
{
    size_t longest = truth->count[0];
    for (int i = 1; i < 3; i++)
    {
        longest = truth->count[i] > longest ? truth->count[i] : longest;
    }
    int64_t length = 1;
    while (length < (int64_t)longest)
    {
        length *= 2;
    }
    judge_crossed(truth, truth->first, length, map, state, errors);
    int64_t voxel[3];
    for (size_t z = 0; z < truth->count[2]; z++)
    {
        voxel[2] = truth->first[2] + (int64_t)z;
        for (size_t y = 0; y < truth->count[1]; y++)
        {
            voxel[1] = truth->first[1] + (int64_t)y;
            for (size_t x = 0; x < truth->count[0]; x++)
            {
                voxel[0] = truth->first[0] + (int64_t)x;
                judge_visible(truth, voxel, map, state, errors);
            }
        }
    }
}

void room_truth_judge_occupied(const room_truth *truth, const double centre[3], room_errors *errors)
{
    errors->occupied++;
    errors->off += room_truth_distance(truth, centre) > 1.5 * truth->edge ? 1 : 0;
}
