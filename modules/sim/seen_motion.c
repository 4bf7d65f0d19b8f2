/* SPDX-License-Identifier: MIT */
#include "seen_motion.h"
#include "tof_world.h"
#include "vector.h"

#include <math.h>

enum
{
    PROBE_COLUMNS = 16,
    PROBE_ROWS = 12
};

/* The world and the camera at two times. */
typedef struct motion
{
    tof_instant *before, *after;
    cm_pose camera[2];
} motion;

/* How far what a ray of the camera's axes meets moves from one time to the other. */
static double motion_along(const motion *of, double ray[3])
{
    double world[3], place[3], seen[3], distance;
    uint32_t id;
    const double length = sqrt(dot(ray, ray));
    if (!(length > 0.0))
    {
        return 0.0;
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
    tof_cast(of->before, 1, origins, directions, &hits);
    if (id == CM_SCENE_NOTHING)
    {
        return 0.0;
    }
    for (int k = 0; k < 3; k++)
    {
        place[k] = from[k] + distance * world[k];
    }
    cm_pose_apply(&tof_instant_surfaces(of->before)[id].body, place, place);
    cm_pose_apply_back(&tof_instant_surfaces(of->after)[id].body, place, place);
    cm_pose_apply(&of->camera[1], place, seen);
    return angle_between(ray, seen);
}

static double most_motion(const motion *of, const tof_sensor *sensor)
{
    double most = 0.0;
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
            most = fmax(most, motion_along(of, ray));
        }
    }
    return most;
}

cm_status seen_motion(const cm_tof_scene *scene, const cm_trajectory *camera,
                      const tof_sensor *sensor, double from, double to, double *most)
{
    motion of = {.before = NULL, .after = NULL};
    *most = 0.0;
    cm_status status = tof_instant_create(scene, from, &of.before);
    status = status == CM_OK ? tof_instant_create(scene, to, &of.after) : status;
    tof_pose_at(camera, from, &of.camera[0]);
    tof_pose_at(camera, to, &of.camera[1]);
    if (status == CM_OK)
    {
        *most = most_motion(&of, sensor);
    }
    tof_instant_destroy(of.before);
    tof_instant_destroy(of.after);
    return status;
}
