/* SPDX-License-Identifier: MIT */
#include "seen_motion.h"
#include "tof_world.h"
#include "vector.h"

#include <math.h>
#include <string.h>

enum
{
    PROBE_COLUMNS = 16,
    PROBE_ROWS = 12
};

/* The world and the camera at two times, either of which is first. */
typedef struct motion
{
    const tof_instant *one, *other;
    cm_pose camera[2];
} motion;

/* How what a ray of the camera's axes meets at one time moves until the other. */
static void add_along(const motion *of, double ray[3], seen_movement *most)
{
    double world[3], place[3], seen[3], distance;
    uint32_t id;
    const double length = sqrt(dot(ray, ray));
    if (!(length > 0.0))
    {
        return;
    }
    for (int k = 0; k < 3; k++)
    {
        ray[k] /= length;
    }
    cm_rotate_back(&of->camera[0].rotation, ray, world);
    const double *const from = of->camera[0].position;
    const double *const origins[3] = {&from[0], &from[1], &from[2]};
    const double *const directions[3] = {&world[0], &world[1], &world[2]};
    const tof_hits hits = {&distance, &id, NULL, {NULL, NULL, NULL}};
    tof_cast(of->one, 1, origins, directions, &hits);
    if (id == CM_SCENE_NOTHING)
    {
        return;
    }
    for (int k = 0; k < 3; k++)
    {
        place[k] = from[k] + distance * world[k];
    }
    cm_pose_apply(&tof_instant_surfaces(of->one)[id].body, place, place);
    cm_pose_apply_back(&tof_instant_surfaces(of->other)[id].body, place, place);
    cm_pose_apply(&of->camera[1], place, seen);
    most->angle = fmax(most->angle, angle_between(ray, seen));
    most->range = fmax(most->range, fabs(sqrt(dot(seen, seen)) - distance));
}

static void add_grid(const motion *of, const tof_sensor *sensor, seen_movement *most)
{
    for (int r = 0; r < PROBE_ROWS; r++)
    {
        double column[PROBE_COLUMNS], row[PROBE_COLUMNS];
        double x[PROBE_COLUMNS], y[PROBE_COLUMNS], z[PROBE_COLUMNS];
        for (int c = 0; c < PROBE_COLUMNS; c++)
        {
            column[c] = ((double)c + 0.5) * sensor->width / PROBE_COLUMNS;
            row[c] = ((double)r + 0.5) * sensor->height / PROBE_ROWS;
        }
        cm_camera_ray_array(sensor->given.camera, PROBE_COLUMNS, column, row, x, y, z);
        for (int c = 0; c < PROBE_COLUMNS; c++)
        {
            double ray[3] = {x[c], y[c], z[c]};
            add_along(of, ray, most);
        }
    }
}

/* Towards a place of the world, if it is in the picture. */
static void add_place(const motion *of, const tof_sensor *sensor, const double place[3],
                      seen_movement *most)
{
    double ray[3], column, row;
    cm_pose_apply(&of->camera[0], place, ray);
    cm_camera_project_array(sensor->given.camera, 1, &ray[0], &ray[1], &ray[2], &column, &row);
    if (column >= -0.5 && column <= sensor->width + 0.5 && row >= -0.5 &&
        row <= sensor->height + 0.5)
    {
        add_along(of, ray, most);
    }
}

static void add_moving(const motion *of, const tof_sensor *sensor, seen_movement *most)
{
    const tof_instant *one = of->one;
    const tof_surface *const here = one->surface, *const there = of->other->surface;
    for (size_t i = 0; i < one->solids; i++)
    {
        const uint32_t id = one->solid[i].id;
        if (isfinite(one->bound[i].radius) &&
            memcmp(&here[id].body, &there[id].body, sizeof here->body) != 0)
        {
            add_place(of, sensor, one->bound[i].centre, most);
        }
    }
    for (size_t i = 0; i < one->bodies; i++)
    {
        const uint32_t id = one->body[i].id;
        if (memcmp(&here[id].body, &there[id].body, sizeof here->body) != 0)
        {
            add_place(of, sensor, one->body[i].centre, most);
        }
    }
}

cm_status seen_motion(const cm_tof_scene *scene, const cm_trajectory *camera,
                      const tof_sensor *sensor, double from, double to, seen_movement *most)
{
    tof_instant *instant[2] = {NULL, NULL};
    cm_pose pose[2];
    cm_status status = tof_instant_create(scene, from, &instant[0]);
    status = status == CM_OK ? tof_instant_create(scene, to, &instant[1]) : status;
    tof_pose_at(camera, from, &pose[0]);
    tof_pose_at(camera, to, &pose[1]);
    for (int first = 0; status == CM_OK && first < 2; first++)
    {
        const motion of = {instant[first], instant[!first], {pose[first], pose[!first]}};
        add_grid(&of, sensor, most);
        add_moving(&of, sensor, most);
    }
    tof_instant_destroy(instant[0]);
    tof_instant_destroy(instant[1]);
    return status;
}
