/* SPDX-License-Identifier: MIT
 *
 * What the measurements of whole frames simulate: a camera of 640 x 480 pixels and one lamp in the analytic room.
 */
#ifndef BENCH_SIM_ROOM_STAGE_H
#define BENCH_SIM_ROOM_STAGE_H

#include <cubemap/sim.h>

#include <stdio.h>
#include <stdlib.h>

enum
{
    WIDTH = 640,
    HEIGHT = 480,
    PIXELS = WIDTH * HEIGHT,
    PHASES = 4
};

typedef struct room_stage
{
    cm_scene *world;
    cm_tof_scene *scene;
    cm_camera *camera;
    cm_trajectory *trajectory;
    cm_tof_sensor sensor;
    cm_tof_light light;
} room_stage;

static inline void need(cm_status status)
{
    if (status != CM_OK)
    {
        fprintf(stderr, "a frame of the room: %s\n", cm_status_text(status));
        exit(1);
    }
}

static inline room_stage room_stage_make(void)
{
    room_stage made = {.light = {.size = sizeof made.light, .power = 1.0, .aperture = 6.28}};
    const cm_camera_options shape = {.size = sizeof shape,
                                     .width = WIDTH,
                                     .height = HEIGHT,
                                     .fx = 525,
                                     .fy = 525,
                                     .cx = 319.5,
                                     .cy = 239.5};
    const double stamp = 0.0, place[3] = {-2.0, 0.3, 1.4}, turn[4] = {0.5, -0.5, 0.5, -0.5};
    cm_pose pose;
    need(cm_pose_from_quaternion(place, turn, &pose));
    need(cm_scene_create_named("room", &made.world));
    need(cm_tof_scene_create(made.world, &made.scene));
    need(cm_camera_create(&shape, &made.camera));
    need(cm_trajectory_create(1, &stamp, &pose, &made.trajectory, NULL));
    made.sensor = (cm_tof_sensor){.size = sizeof made.sensor,
                                  .camera = made.camera,
                                  .pitch = 12e-6,
                                  .f_number = 1.0,
                                  .wavelength = 850e-9,
                                  .efficiency = 0.4,
                                  .exposure = 1e-3,
                                  .frequency = 20e6,
                                  .duty = 0.5,
                                  .contrast = 0.8,
                                  .phases = PHASES};
    return made;
}

static inline void room_stage_free(room_stage *stage)
{
    cm_trajectory_destroy(stage->trajectory);
    cm_camera_destroy(stage->camera);
    cm_tof_scene_destroy(stage->scene);
    cm_scene_destroy(stage->world);
}

static inline void room_stage_simulate(const room_stage *stage, const cm_tof_options *options,
                                       cm_pool *pool, cm_tof_result *to)
{
    need(cm_tof_simulate(stage->scene, &stage->sensor, &stage->light, 1, stage->trajectory, 0.0,
                         options, pool, to));
}

#endif
