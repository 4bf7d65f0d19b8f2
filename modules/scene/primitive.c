/* SPDX-License-Identifier: MIT
 *
 * Boxes, spheres and cylinders are convex: a ray is inside from one distance to another, and each of their parts takes a
 * piece off that. The roots of spheres and walls are those of Haines, Günther and Akenine-Möller, "Precision improvements
 * for ray/sphere intersection", Ray Tracing Gems (2019), chapter 7: no digit is lost far from the sphere or beside it.
 */
#include "primitive.h"

#include <float.h>
#include <math.h>

/* Where a ray is inside, and through which faces it comes and goes. */
typedef struct span
{
    double enter, leave;
    int enter_face, leave_face;
} span;

enum
{
    WALL = 0, /* of a cylinder */
    FROM_CAP = 2,
    TO_CAP = 3
};

double make_unit(double vector[3])
{
    const double most = fmax(fabs(vector[0]), fmax(fabs(vector[1]), fabs(vector[2])));
    if (!(most > 0.0) || !isfinite(most))
    {
        return 0.0;
    }
    for (int i = 0; i < 3; i++)
    {
        vector[i] /= most;
    }
    const double length = sqrt(dot(vector, vector));
    for (int i = 0; i < 3; i++)
    {
        vector[i] /= length;
    }
    return most * length;
}

/* 0 if nothing is left. */
static int clip(span *inside, double enter, double leave, int enter_face, int leave_face)
{
    if (enter > inside->enter)
    {
        inside->enter = enter;
        inside->enter_face = enter_face;
    }
    if (leave < inside->leave)
    {
        inside->leave = leave;
        inside->leave_face = leave_face;
    }
    return inside->enter <= inside->leave;
}

/* Between two parallel planes; the faces are face and face + 1. */
static int clip_slab(span *inside, double origin, double direction, double least, double greatest,
                     int face)
{
    if (direction == 0.0)
    {
        return origin >= least && origin <= greatest;
    }
    const double to_least = (least - origin) / direction;
    const double to_greatest = (greatest - origin) / direction;
    return direction > 0.0 ? clip(inside, to_least, to_greatest, face, face + 1)
                           : clip(inside, to_greatest, to_least, face + 1, face);
}

/* Where |from + distance along| <= radius. */
static int clip_round(span *inside, const double from[3], const double along[3], double radius)
{
    const double square = dot(along, along);
    const double apart = sqrt(dot(from, from));
    if (square < DBL_MIN) /* along the axis */
    {
        return apart <= radius;
    }
    const double half = dot(from, along);
    double nearest[3];
    for (int i = 0; i < 3; i++)
    {
        nearest[i] = from[i] - half / square * along[i];
    }
    const double closest = sqrt(dot(nearest, nearest));
    const double rest = (radius - closest) * (radius + closest);
    if (!(rest >= 0.0))
    {
        return 0;
    }
    const double sum = -half - copysign(sqrt(square * rest), half);
    const double one = sum / square;
    const double other = sum == 0.0 ? 0.0 : (apart - radius) * (apart + radius) / sum;
    return clip(inside, fmin(one, other), fmax(one, other), WALL, WALL);
}

static int clip_box(span *inside, const cm_primitive *box, const ray *along)
{
    for (int i = 0; i < 3; i++)
    {
        if (!clip_slab(inside, along->origin[i], along->direction[i], box->first[i], box->second[i],
                       2 * i))
        {
            return 0;
        }
    }
    return 1;
}

/* The wall is a circle in the plane across the axis, seen turned by a right angle: vectors times the axis. */
static int clip_cylinder(span *inside, const solid *cylinder, const ray *along)
{
    double from[3], across[3], moved[3];
    subtract(along->origin, cylinder->given.first, from);
    cross(from, cylinder->axis, across);
    cross(along->direction, cylinder->axis, moved);
    return clip_round(inside, across, moved, cylinder->given.radius) &&
           clip_slab(inside, dot(from, cylinder->axis), dot(along->direction, cylinder->axis), 0.0,
                     cylinder->length, FROM_CAP);
}

static int meet_plane(const cm_primitive *plane, const ray *along, meeting *found)
{
    double to[3];
    subtract(plane->first, along->origin, to);
    const double speed = dot(along->direction, plane->second);
    found->distance = speed == 0.0 ? -1.0 : dot(to, plane->second) / speed;
    found->face = 0;
    return found->distance > 0.0 && found->distance < INFINITY;
}

int meet_solid(const solid *surface, const ray *along, meeting *found)
{
    span inside = {-INFINITY, INFINITY, 0, 0};
    double from[3];
    int any = 0;
    switch (surface->given.kind)
    {
    case CM_PRIMITIVE_PLANE:
        return meet_plane(&surface->given, along, found);
    case CM_PRIMITIVE_BOX:
        any = clip_box(&inside, &surface->given, along);
        break;
    case CM_PRIMITIVE_SPHERE:
        subtract(along->origin, surface->given.first, from);
        any = clip_round(&inside, from, along->direction, surface->given.radius);
        break;
    case CM_PRIMITIVE_CYLINDER:
        any = clip_cylinder(&inside, surface, along);
        break;
    default:
        break;
    }
    found->distance = inside.enter > 0.0 ? inside.enter : inside.leave;
    found->face = inside.enter > 0.0 ? inside.enter_face : inside.leave_face;
    return any && found->distance > 0.0 && found->distance < INFINITY;
}

void normal_of(const solid *surface, const double point[3], int face, double normal[3])
{
    const cm_primitive *given = &surface->given;
    const int is_box = given->kind == CM_PRIMITIVE_BOX;
    subtract(point, given->first, normal);
    const double height = dot(normal, surface->axis);
    for (int i = 0; i < 3; i++)
    {
        const double round = normal[i] - height * surface->axis[i]; /* a sphere's axis is 0 */
        const double flat = given->kind == CM_PRIMITIVE_PLANE ? given->second[i]
                            : is_box                          ? (double)(i == face / 2)
                                                              : surface->axis[i];
        normal[i] = is_box || given->kind == CM_PRIMITIVE_PLANE || face != WALL ? flat : round;
    }
}
