/* SPDX-License-Identifier: MIT */
#include "ray_truth.h"

#include <math.h>

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 wide;
#else
typedef long double wide;
#endif

typedef struct wide_ray
{
    wide origin[3], direction[3];
    wide nearest, next;
} wide_ray;

static wide wide_dot(const wide a[3], const wide b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* By Heron from the double's root: two steps are 2^-200. */
static wide root(wide square)
{
    wide x = (wide)sqrt((double)square);
    for (int i = 0; i < 3 && x > 0; i++)
    {
        x = (x + square / x) / 2;
    }
    return x;
}

static void wide_from(const double from[3], wide to[3])
{
    for (int i = 0; i < 3; i++)
    {
        to[i] = (wide)from[i];
    }
}

/* 1 if it is the nearest so far. */
static int take(wide_ray *ray, wide distance)
{
    const int nearest = distance > 0 && distance < ray->nearest;
    if (nearest)
    {
        ray->next = ray->nearest;
        ray->nearest = distance;
    }
    else if (distance > ray->nearest && distance < ray->next)
    {
        ray->next = distance;
    }
    return nearest;
}

static int meets_plane(wide_ray *ray, const cm_primitive *plane)
{
    wide point[3], normal[3], to[3];
    wide_from(plane->first, point);
    wide_from(plane->second, normal);
    for (int i = 0; i < 3; i++)
    {
        to[i] = point[i] - ray->origin[i];
    }
    const wide speed = wide_dot(normal, ray->direction);
    return speed != 0 && take(ray, wide_dot(to, normal) / speed);
}

/* Six rectangles. */
static int meets_box(wide_ray *ray, const cm_primitive *box)
{
    int met = 0;
    for (int face = 0; face < 6; face++)
    {
        const int axis = face / 2;
        const double at = face % 2 == 0 ? box->first[axis] : box->second[axis];
        if (ray->direction[axis] == 0)
        {
            continue;
        }
        const wide distance = ((wide)at - ray->origin[axis]) / ray->direction[axis];
        int inside = 1;
        for (int i = 0; i < 3; i++)
        {
            const wide place = ray->origin[i] + distance * ray->direction[i];
            inside = inside &&
                     (i == axis || (place >= (wide)box->first[i] && place <= (wide)box->second[i]));
        }
        met |= inside && take(ray, distance);
    }
    return met;
}

/* a t^2 + 2 b t + c = 0 */
static int solve(wide a, wide b, wide c, wide roots[2])
{
    const wide square = b * b - a * c;
    if (a == 0 || square < 0)
    {
        return 0;
    }
    roots[0] = (-b - root(square)) / a;
    roots[1] = (-b + root(square)) / a;
    return 1;
}

static int meets_sphere(wide_ray *ray, const cm_primitive *sphere)
{
    wide from[3], roots[2];
    for (int i = 0; i < 3; i++)
    {
        from[i] = ray->origin[i] - (wide)sphere->first[i];
    }
    const wide radius = (wide)sphere->radius;
    if (!solve(wide_dot(ray->direction, ray->direction), wide_dot(from, ray->direction),
               wide_dot(from, from) - radius * radius, roots))
    {
        return 0;
    }
    const int one = take(ray, roots[0]);
    return take(ray, roots[1]) || one;
}

/* The wall, then the two caps. Components along the axis are taken away, times the axis's square. */
static int meets_cylinder(wide_ray *ray, const cm_primitive *cylinder)
{
    wide axis[3], from[3], across[3], moved[3], roots[2];
    for (int i = 0; i < 3; i++)
    {
        axis[i] = (wide)cylinder->second[i] - (wide)cylinder->first[i];
        from[i] = ray->origin[i] - (wide)cylinder->first[i];
    }
    const wide square = wide_dot(axis, axis);
    const wide height = wide_dot(from, axis), speed = wide_dot(ray->direction, axis);
    for (int i = 0; i < 3; i++)
    {
        across[i] = square * from[i] - height * axis[i];
        moved[i] = square * ray->direction[i] - speed * axis[i];
    }
    const wide radius = (wide)cylinder->radius * square;
    const int round = solve(wide_dot(moved, moved), wide_dot(across, moved),
                            wide_dot(across, across) - radius * radius, roots);
    int met = 0;
    for (int i = 0; round && i < 2; i++)
    {
        const wide place = height + roots[i] * speed;
        met |= place >= 0 && place <= square && take(ray, roots[i]);
    }
    for (int i = 0; speed != 0 && i < 2; i++)
    {
        const wide distance = ((i == 0 ? 0 : square) - height) / speed;
        wide place[3];
        for (int k = 0; k < 3; k++)
        {
            place[k] = across[k] + distance * moved[k];
        }
        met |= wide_dot(place, place) <= radius * radius && take(ray, distance);
    }
    return met;
}

static void wide_cross(const wide a[3], const wide b[3], wide product[3])
{
    for (int i = 0; i < 3; i++)
    {
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

/* The corner of a triangle in the world. */
static void corner_in_world(const cm_primitive *given, uint32_t vertex, wide corner[3])
{
    const double *at = cm_mesh_describe(given->mesh)->position + 3 * (size_t)vertex;
    for (int i = 0; i < 3; i++)
    {
        corner[i] = (wide)given->pose.position[i];
        for (int k = 0; k < 3; k++)
        {
            corner[i] += (wide)given->pose.rotation.row[k][i] * (wide)at[k];
        }
    }
}

static int meets_triangle(wide_ray *ray, const cm_primitive *given, const uint32_t index[3])
{
    wide corner[3][3], one[3], other[3], from[3], p[3], q[3];
    for (int i = 0; i < 3; i++)
    {
        corner_in_world(given, index[i], corner[i]);
    }
    for (int i = 0; i < 3; i++)
    {
        one[i] = corner[1][i] - corner[0][i];
        other[i] = corner[2][i] - corner[0][i];
        from[i] = ray->origin[i] - corner[0][i];
    }
    wide_cross(ray->direction, other, p);
    wide_cross(from, one, q);
    const wide determinant = wide_dot(one, p);
    if (determinant == 0)
    {
        return 0;
    }
    const wide u = wide_dot(from, p) / determinant;
    const wide v = wide_dot(ray->direction, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && take(ray, wide_dot(other, q) / determinant);
}

/* Whether the ray's line is so far from a triangle that doubles can tell: from its first corner by more than its longer
 * edge there, and by a millionth of all lengths more, where their errors are of 1e-15. */
static int is_clearly_beside(const wide_ray *ray, const cm_primitive *given,
                             const uint32_t index[3])
{
    double corner[3][3], direction[3], to[3], edge[2] = {0.0, 0.0}, all = 0.0, length = 0.0;
    const double *const vertex = cm_mesh_describe(given->mesh)->position;
    for (int i = 0; i < 3; i++)
    {
        cm_pose_apply_back(&given->pose, vertex + 3 * (size_t)index[i], corner[i]);
    }
    for (int i = 0; i < 3; i++)
    {
        direction[i] = (double)ray->direction[i];
        to[i] = corner[0][i] - (double)ray->origin[i];
        edge[0] += (corner[1][i] - corner[0][i]) * (corner[1][i] - corner[0][i]);
        edge[1] += (corner[2][i] - corner[0][i]) * (corner[2][i] - corner[0][i]);
        all += fabs(corner[0][i]) + fabs((double)ray->origin[i]) + fabs(given->pose.position[i]);
        length += direction[i] * direction[i];
    }
    double off = 0.0;
    for (int i = 0; i < 3; i++)
    {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double product = to[j] * direction[k] - to[k] * direction[j];
        off += product * product;
    }
    return sqrt(off / length) > sqrt(fmax(edge[0], edge[1])) + 1e-6 * all;
}

static int meets_mesh(wide_ray *ray, const cm_primitive *given)
{
    const cm_mesh_options *mesh = cm_mesh_describe(given->mesh);
    int met = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++)
    {
        const uint32_t *const index = mesh->index + 3 * i;
        met |= !is_clearly_beside(ray, given, index) && meets_triangle(ray, given, index);
    }
    return met;
}

double ray_truth(const cm_scene *scene, const double origin[3], const double direction[3],
                 uint32_t *id, double *next)
{
    static int (*const meets[])(wide_ray *, const cm_primitive *) = {
        meets_plane, meets_box, meets_sphere, meets_cylinder, meets_mesh};
    wide_ray ray = {.nearest = (wide)INFINITY, .next = (wide)INFINITY};
    wide_from(origin, ray.origin);
    wide_from(direction, ray.direction);
    *id = CM_SCENE_NOTHING;
    for (uint32_t i = 0; i < cm_scene_count(scene); i++)
    {
        const cm_primitive *given = cm_scene_at(scene, i);
        if (meets[given->kind](&ray, given))
        {
            *id = i;
        }
    }
    if (next != NULL)
    {
        *next = (double)ray.next;
    }
    return (double)ray.nearest;
}
