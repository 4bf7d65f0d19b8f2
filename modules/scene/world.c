/* SPDX-License-Identifier: MIT */
#include "modules/memory/checked_size.h"
#include "mesh_tree.h"
#include "named_world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    SOLIDS_END = INT32_MAX
};

struct cm_scene
{
    solid *solids;
    size_t count, room;
};

/* ------------------------------------------------------------------------------- what it is made of */

cm_status cm_scene_create(cm_scene **scene)
{
    if (scene == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_scene *made = calloc(1, sizeof *made);
    if (made == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    *scene = made;
    return CM_OK;
}

void cm_scene_destroy(cm_scene *scene)
{
    if (scene != NULL)
    {
        free(scene->solids);
        free(scene);
    }
}

cm_status cm_scene_create_named(const char *name, cm_scene **scene)
{
    const named_world *named = name == NULL ? NULL : find_named_world(name);
    if (named == NULL || scene == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_scene *made = NULL;
    cm_status status = cm_scene_create(&made);
    for (size_t i = 0; status == CM_OK && i < named->count; i++)
    {
        status = cm_scene_add(made, &named->primitives[i], NULL);
    }
    if (status != CM_OK)
    {
        cm_scene_destroy(made);
        return status;
    }
    *scene = made;
    return CM_OK;
}

static int is_fraction(double value)
{
    return value >= 0.0 && value <= 1.0;
}

static int is_finite(const double point[3])
{
    return fabs(point[0]) < COORDINATE_END && fabs(point[1]) < COORDINATE_END &&
           fabs(point[2]) < COORDINATE_END;
}

static int is_radius(double radius)
{
    return radius > 0.0 && radius < COORDINATE_END;
}

/* What the kind needs; the rest is found. 0 if it is none. */
static int complete(solid *made)
{
    cm_primitive *given = &made->given;
    switch (given->kind)
    {
    case CM_PRIMITIVE_PLANE:
        return is_finite(given->first) && make_unit(given->second) > 0.0;
    case CM_PRIMITIVE_BOX:
        return is_finite(given->first) && is_finite(given->second) &&
               given->first[0] < given->second[0] && given->first[1] < given->second[1] &&
               given->first[2] < given->second[2];
    case CM_PRIMITIVE_SPHERE:
        return is_finite(given->first) && is_radius(given->radius);
    case CM_PRIMITIVE_CYLINDER:
        subtract(given->second, given->first, made->axis);
        made->length =
            is_finite(given->first) && is_finite(given->second) ? make_unit(made->axis) : 0.0;
        return made->length > 0.0 && is_radius(given->radius);
    default:
        return is_finite(given->pose.position) && cm_rotation_check(&given->pose.rotation) == CM_OK;
    }
}

static cm_status grow(cm_scene *scene)
{
    if (scene->count < scene->room)
    {
        return CM_OK;
    }
    const size_t room = scene->room == 0 ? 16 : 2 * scene->room;
    solid *moved = cm_array_resized(scene->solids, room, sizeof *moved);
    if (moved == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    scene->solids = moved;
    scene->room = room;
    return CM_OK;
}

cm_status cm_scene_add(cm_scene *scene, const cm_primitive *primitive, uint32_t *id)
{
    if (scene == NULL || primitive == NULL || primitive->size != sizeof *primitive ||
        (int)primitive->kind < 0 || primitive->kind > CM_PRIMITIVE_MESH ||
        (primitive->kind == CM_PRIMITIVE_MESH && primitive->mesh == NULL) ||
        scene->count >= SOLIDS_END)
    {
        return CM_ERROR_ARGUMENT;
    }
    solid made;
    memset(&made, 0, sizeof made);
    made.given = *primitive;
    const double *color = primitive->material.color;
    if (!is_fraction(color[0]) || !is_fraction(color[1]) || !is_fraction(color[2]) ||
        !is_fraction(primitive->material.reflectance) || !complete(&made))
    {
        return CM_ERROR_RANGE;
    }
    const cm_status status = grow(scene);
    if (status == CM_OK)
    {
        scene->solids[scene->count] = made;
        if (id != NULL)
        {
            *id = (uint32_t)scene->count;
        }
        scene->count++;
    }
    return status;
}

size_t cm_scene_count(const cm_scene *scene)
{
    return scene->count;
}

const cm_primitive *cm_scene_at(const cm_scene *scene, uint32_t id)
{
    return id < scene->count ? &scene->solids[id].given : NULL;
}

/* ------------------------------------------------------------------------------- rays */

/* Where a ray ends, and what is there. */
typedef struct seen
{
    meeting at;
    uint32_t id;
    double normal[3], color[3];
    double reflectance;
} seen;

/* In a mesh's axes distances are the same. */
static ray ray_in(const cm_pose *pose, const ray *along)
{
    ray turned;
    cm_pose_apply(pose, along->origin, turned.origin);
    cm_rotate(&pose->rotation, along->direction, turned.direction);
    return turned;
}

static void find_nearest(const cm_scene *scene, const ray *along, seen *found)
{
    for (size_t i = 0; i < scene->count; i++)
    {
        const solid *surface = &scene->solids[i];
        meeting at = {found->at.distance, 0, 0, {0.0}};
        int met;
        if (surface->given.kind == CM_PRIMITIVE_MESH)
        {
            const ray turned = ray_in(&surface->given.pose, along);
            met = meet_mesh(surface->given.mesh, &turned, &at);
        }
        else
        {
            met = meet_solid(surface, along, &at);
        }
        if (met && at.distance < found->at.distance)
        {
            found->at = at;
            found->id = (uint32_t)i;
        }
    }
}

/* Normal and colour of a triangle. */
static void look_at_triangle(const cm_primitive *given, seen *found)
{
    const cm_mesh_options *mesh = cm_mesh_describe(given->mesh);
    const uint32_t *index = mesh->index + 3 * (size_t)found->at.triangle;
    const double *corner = mesh->position + 3 * (size_t)index[0];
    double one[3], other[3];
    subtract(mesh->position + 3 * (size_t)index[1], corner, one);
    subtract(mesh->position + 3 * (size_t)index[2], corner, other);
    (void)make_unit(one);
    (void)make_unit(other);
    cross(one, other, found->normal);
    cm_rotate_back(&given->pose.rotation, found->normal, found->normal);
    for (size_t i = 0; i < 3; i++)
    {
        double color = mesh->color == NULL ? 1.0 : 0.0;
        for (size_t k = 0; mesh->color != NULL && k < 3; k++)
        {
            color += found->at.weight[k] * (double)mesh->color[3 * (size_t)index[k] + i];
        }
        found->color[i] *= fmin(fmax(color, 0.0), 1.0) * mesh->material.color[i];
    }
    found->reflectance *= mesh->material.reflectance;
}

static void look(const solid *surface, const ray *along, seen *found)
{
    const cm_material *material = &surface->given.material;
    memcpy(found->color, material->color, sizeof found->color);
    found->reflectance = material->reflectance;
    if (surface->given.kind == CM_PRIMITIVE_MESH)
    {
        look_at_triangle(&surface->given, found);
    }
    else
    {
        double point[3];
        for (int i = 0; i < 3; i++)
        {
            point[i] = along->origin[i] + found->at.distance * along->direction[i];
        }
        normal_of(surface, point, found->at.face, found->normal);
    }
    if (make_unit(found->normal) == 0.0) /* of what is a line or a point to rounding */
    {
        memcpy(found->normal, along->direction, sizeof found->normal);
        (void)make_unit(found->normal);
    }
    const double side = dot(found->normal, along->direction) > 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++)
    {
        found->normal[i] = side * found->normal[i] + 0.0;
    }
}

static void put(const cm_hit_arrays *hit, size_t i, const seen *found)
{
    if (hit->distance != NULL)
    {
        hit->distance[i] = found->at.distance;
    }
    if (hit->id != NULL)
    {
        hit->id[i] = found->id;
    }
    if (hit->triangle != NULL)
    {
        hit->triangle[i] = found->at.triangle;
    }
    for (int k = 0; k < 3; k++)
    {
        if (hit->normal[k] != NULL)
        {
            hit->normal[k][i] = found->normal[k];
        }
        if (hit->color[k] != NULL)
        {
            hit->color[k][i] = found->color[k];
        }
    }
    if (hit->reflectance != NULL)
    {
        hit->reflectance[i] = found->reflectance;
    }
}

void cm_scene_cast_array(const cm_scene *scene, size_t n, const double *origin_x,
                         const double *origin_y, const double *origin_z, const double *direction_x,
                         const double *direction_y, const double *direction_z,
                         const cm_hit_arrays *hit)
{
    for (size_t i = 0; i < n; i++)
    {
        ray along = {{origin_x[i], origin_y[i], origin_z[i]},
                     {direction_x[i], direction_y[i], direction_z[i]}};
        seen found = {{NAN, 0, 0, {0.0}}, CM_SCENE_NOTHING, {NAN, NAN, NAN}, {0.0}, 0.0};
        const double most = fmax(fabs(along.direction[0]),
                                 fmax(fabs(along.direction[1]), fabs(along.direction[2])));
        /* a NaN beside numbers is not the greatest */
        const double sum = along.direction[0] + along.direction[1] + along.direction[2];
        if (most > 0.0 && most < INFINITY && !isnan(sum) && is_finite(along.origin))
        {
            int exponent;
            (void)frexp(most, &exponent);
            for (int k = 0; k < 3; k++)
            {
                along.direction[k] = ldexp(along.direction[k], -exponent);
            }
            found.at.distance = INFINITY;
            find_nearest(scene, &along, &found);
            if (found.id != CM_SCENE_NOTHING)
            {
                look(&scene->solids[found.id], &along, &found);
            }
            found.at.distance = ldexp(found.at.distance, -exponent);
        }
        put(hit, i, &found);
    }
}
