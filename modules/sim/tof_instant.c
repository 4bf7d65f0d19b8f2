/* SPDX-License-Identifier: MIT */
#include "tof_world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const cm_pose still = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}};

void tof_pose_at(const cm_trajectory *motion, double time, cm_pose *pose)
{
    *pose = still;
    if (motion != NULL && cm_trajectory_interpolate(motion, time, pose) != CM_OK)
    {
        double first = 0.0;
        (void)cm_trajectory_at(motion, 0, &first, NULL);
        (void)cm_trajectory_at(motion, time < first ? 0 : cm_trajectory_count(motion) - 1, NULL,
                               pose);
    }
}

int tof_scene_moves(const cm_tof_scene *scene, double from, double to)
{
    for (size_t i = 0; i < scene->count; i++)
    {
        const cm_trajectory *motion = scene->primitive[i].motion;
        double first = 0.0, last = 0.0;
        if (motion != NULL && cm_trajectory_count(motion) > 1)
        {
            (void)cm_trajectory_at(motion, 0, &first, NULL);
            (void)cm_trajectory_at(motion, cm_trajectory_count(motion) - 1, &last, NULL);
            if (from < last && to > first)
            {
                return 1;
            }
        }
    }
    return 0;
}

int tof_trajectory_bends(const cm_trajectory *trajectory, double from, double to)
{
    const double half = 0.5 * (to - from) * (1.0 - 1e-9); /* not at either end */
    size_t index;
    return trajectory != NULL && cm_trajectory_count(trajectory) > 1 &&
           cm_trajectory_nearest(trajectory, 0.5 * (from + to), half, &index) == CM_OK;
}

int tof_scene_bends(const cm_tof_scene *scene, double from, double to)
{
    int any = 0;
    for (size_t i = 0; i < scene->count && !any; i++)
    {
        any = tof_trajectory_bends(scene->primitive[i].motion, from, to);
    }
    return any;
}

static void put_box(const cm_primitive *given, const cm_pose *pose, tof_solid *solid)
{
    double middle[3];
    for (int i = 0; i < 3; i++)
    {
        middle[i] = 0.5 * (given->first[i] + given->second[i]);
        solid->half[i] = 0.5 * (given->second[i] - given->first[i]);
        for (int k = 0; k < 3; k++)
        {
            solid->axis[i][k] = pose->rotation.row[i][k];
        }
    }
    cm_pose_apply_back(pose, middle, solid->centre);
}

static void put_cylinder(const cm_primitive *given, const cm_pose *pose, tof_solid *solid)
{
    double from[3], to[3], square = 0.0;
    cm_pose_apply_back(pose, given->first, from);
    cm_pose_apply_back(pose, given->second, to);
    for (int i = 0; i < 3; i++)
    {
        solid->centre[i] = 0.5 * (from[i] + to[i]);
        solid->axis[0][i] = to[i] - from[i];
        square += solid->axis[0][i] * solid->axis[0][i];
    }
    const double length = sqrt(square);
    solid->half[0] = 0.5 * length;
    for (int i = 0; i < 3; i++)
    {
        solid->axis[0][i] /= length;
    }
}

/* Into the world's axes; and a ball around it. */
static void put_solid(const cm_primitive *given, uint32_t id, const cm_pose *pose, tof_solid *solid,
                      tof_bound *bound)
{
    memset(solid, 0, sizeof *solid);
    solid->kind = given->kind;
    solid->id = id;
    solid->radius = given->radius;
    bound->radius = INFINITY;
    switch (given->kind)
    {
    case CM_PRIMITIVE_PLANE:
        cm_pose_apply_back(pose, given->first, solid->centre);
        cm_rotate_back(&pose->rotation, given->second, solid->axis[0]);
        break;
    case CM_PRIMITIVE_BOX:
        put_box(given, pose, solid);
        bound->radius = sqrt(solid->half[0] * solid->half[0] + solid->half[1] * solid->half[1] +
                             solid->half[2] * solid->half[2]);
        break;
    case CM_PRIMITIVE_SPHERE:
        cm_pose_apply_back(pose, given->first, solid->centre);
        bound->radius = given->radius;
        break;
    default:
        put_cylinder(given, pose, solid);
        bound->radius = hypot(solid->half[0], given->radius);
        break;
    }
    memcpy(bound->centre, solid->centre, sizeof bound->centre);
}

static void put_body(const cm_primitive *given, const mesh_rays *rays, uint32_t id,
                     const cm_pose *pose, tof_body *body)
{
    double centre[3];
    body->rays = rays;
    body->id = id;
    /* x_mesh = R_mesh (R (x - p) - p_mesh) */
    cm_pose_compose(pose, &given->pose, &body->pose);
    mesh_rays_bound(rays, centre, &body->radius);
    cm_pose_apply_back(&body->pose, centre, body->centre);
}

static void put_surface(const cm_primitive *given, const cm_pose *pose, tof_surface *surface)
{
    surface->reflectance = given->material.reflectance;
    if (given->kind == CM_PRIMITIVE_MESH)
    {
        surface->reflectance *= cm_mesh_describe(given->mesh)->material.reflectance;
    }
    surface->brdf = given->brdf;
    surface->body = *pose;
}

cm_status tof_instant_create(const cm_tof_scene *scene, double time, tof_instant **made)
{
    tof_instant *instant = calloc(1, sizeof *instant);
    if (instant == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    instant->set = scene->set;
    instant->surface = calloc(scene->count, sizeof *instant->surface);
    instant->solid = calloc(scene->count, sizeof *instant->solid);
    instant->bound = calloc(scene->count, sizeof *instant->bound);
    instant->body = calloc(scene->count, sizeof *instant->body);
    if (instant->surface == NULL || instant->solid == NULL || instant->bound == NULL ||
        instant->body == NULL)
    {
        tof_instant_destroy(instant);
        return CM_ERROR_MEMORY;
    }
    for (size_t i = 0; i < scene->count; i++)
    {
        const cm_primitive *given = &scene->primitive[i];
        cm_pose pose;
        tof_pose_at(given->motion, time, &pose);
        put_surface(given, &pose, &instant->surface[i]);
        instant->has_brdf |= given->brdf != NULL;
        if (given->kind == CM_PRIMITIVE_MESH)
        {
            put_body(given, scene->rays[i], (uint32_t)i, &pose, &instant->body[instant->bodies++]);
        }
        else
        {
            put_solid(given, (uint32_t)i, &pose, &instant->solid[instant->solids],
                      &instant->bound[instant->solids]);
            instant->solids++;
        }
    }
    *made = instant;
    return CM_OK;
}

void tof_instant_destroy(tof_instant *instant)
{
    if (instant != NULL)
    {
        free(instant->surface);
        free(instant->solid);
        free(instant->bound);
        free(instant->body);
        free(instant);
    }
}

const tof_surface *tof_instant_surfaces(const tof_instant *instant)
{
    return instant->surface;
}
