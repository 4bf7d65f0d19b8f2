/* SPDX-License-Identifier: MIT
 *
 * A camera of 64 by 48 pixels at the origin with a light beside it, before what a test wants; and what it measured last.
 */
#ifndef TESTS_SIM_TOF_STAGE_H
#define TESTS_SIM_TOF_STAGE_H

#include <cubemap/sim.h>

#include "tests/suite.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

enum
{
    WIDTH = 64,
    HEIGHT = 48,
    PIXELS = WIDTH * HEIGHT,
    PHASES = 4
};

typedef struct stage
{
    cm_scene *world;
    cm_tof_scene *scene;
    cm_camera *camera;
    cm_tof_sensor sensor;
    cm_tof_light light;
} stage;

static float phase[8 * PIXELS], charge_a[8 * PIXELS], charge_b[8 * PIXELS], distance[PIXELS],
    amplitude[PIXELS], intensity[PIXELS];
static uint8_t flags[PIXELS];

static inline cm_camera *make_camera(double focal)
{
    const cm_camera_options shape = {.size = sizeof shape,
                                     .width = WIDTH,
                                     .height = HEIGHT,
                                     .fx = focal,
                                     .fy = focal,
                                     .cx = 32.0, /* the middle of a pixel */
                                     .cy = 24.0};
    cm_camera *camera = NULL;
    ck_assert_int_eq(cm_camera_create(&shape, &camera), CM_OK);
    return camera;
}

static inline stage make_stage(const cm_primitive *primitive, size_t count)
{
    stage made;
    memset(&made, 0, sizeof made);
    ck_assert_int_eq(cm_scene_create(&made.world), CM_OK);
    for (size_t i = 0; i < count; i++)
    {
        ck_assert_int_eq(cm_scene_add(made.world, &primitive[i], NULL), CM_OK);
    }
    ck_assert_int_eq(cm_tof_scene_create(made.world, &made.scene), CM_OK);
    made.camera = make_camera(50.0);
    const cm_tof_sensor sensor = {.size = sizeof sensor,
                                  .camera = made.camera,
                                  .pitch = 12e-6,
                                  .f_number = 1.2,
                                  .wavelength = 850e-9,
                                  .efficiency = 0.4,
                                  .exposure = 5e-3,
                                  .frequency = 20e6,
                                  .duty = 0.5,
                                  .contrast = 0.8,
                                  .phases = PHASES};
    const cm_tof_light light = {.size = sizeof light, .power = 0.7, .aperture = 2.0 * PI};
    made.sensor = sensor;
    made.light = light;
    return made;
}

static inline void free_stage(stage *made)
{
    cm_camera_destroy(made->camera);
    cm_tof_scene_destroy(made->scene);
    cm_scene_destroy(made->world);
}

static inline cm_tof_result whole_result(void)
{
    const cm_tof_result result = {.size = sizeof result,
                                  .phase = phase,
                                  .charge_a = charge_a,
                                  .charge_b = charge_b,
                                  .distance = distance,
                                  .amplitude = amplitude,
                                  .intensity = intensity,
                                  .flags = flags};
    return result;
}

static inline cm_status simulate(const stage *of, const cm_tof_options *options)
{
    cm_tof_result result = whole_result();
    return cm_tof_simulate(of->scene, &of->sensor, &of->light, 1, NULL, 0.0, options, NULL,
                           &result);
}

static const cm_primitive wall = {.size = sizeof wall,
                                  .kind = CM_PRIMITIVE_PLANE,
                                  .first = {0, 0, 1.7},
                                  .second = {0, 0, 1},
                                  .material = {{1, 1, 1}, 0.6}};

#endif
