/* SPDX-License-Identifier: MIT
 *
 * Frames a second of two threads of one process beside those of two processes with a thread each, 640 x 480 pixels in the analytic
 * room: both take turns in rounds, and the median of the rounds' quotients counts, which what else the machine does changes least.
 *
 *   simulate-threads [ROUNDS [FRAMES]]
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/sim.h>

#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum
{
    WIDTH = 640,
    HEIGHT = 480,
    PIXELS = WIDTH * HEIGHT,
    PHASES = 4,
    ROUNDS_MOST = 1001
};

static float phase[PHASES * PIXELS], distance[PIXELS], amplitude[PIXELS], intensity[PIXELS];

static void need(int is_good)
{
    if (!is_good)
    {
        fputs("simulate-threads: something failed\n", stderr);
        exit(1);
    }
}

typedef struct stage
{
    cm_scene *world;
    cm_tof_scene *scene;
    cm_camera *camera;
    cm_trajectory *trajectory;
    cm_tof_sensor sensor;
} stage;

static stage make_stage(void)
{
    stage made = {0};
    const cm_camera_options shape = {.size = sizeof shape,
                                     .width = WIDTH,
                                     .height = HEIGHT,
                                     .fx = 525,
                                     .fy = 525,
                                     .cx = 319.5,
                                     .cy = 239.5};
    const double stamp = 0.0, place[3] = {-2.0, 0.3, 1.4}, turn[4] = {0.5, -0.5, 0.5, -0.5};
    cm_pose pose;
    need(cm_pose_from_quaternion(place, turn, &pose) == CM_OK);
    need(cm_scene_create_named("room", &made.world) == CM_OK);
    need(cm_tof_scene_create(made.world, &made.scene) == CM_OK);
    need(cm_camera_create(&shape, &made.camera) == CM_OK);
    need(cm_trajectory_create(1, &stamp, &pose, &made.trajectory, NULL) == CM_OK);
    const cm_tof_sensor sensor = {.size = sizeof sensor,
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
    made.sensor = sensor;
    return made;
}

static void make_frames(const stage *of, const cm_tof_options *options, int frames, cm_pool *pool)
{
    const cm_tof_light light = {.size = sizeof light, .power = 1.0, .aperture = 6.28};
    for (int i = 0; i < frames; i++)
    {
        cm_tof_result to = {.size = sizeof to,
                            .phase = phase,
                            .distance = distance,
                            .amplitude = amplitude,
                            .intensity = intensity};
        need(cm_tof_simulate(of->scene, &of->sensor, &light, 1, of->trajectory, 0.0, options, pool,
                             &to) == CM_OK);
    }
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Seconds until two processes have made so many frames each. */
static double by_processes(const stage *of, const cm_tof_options *options, int frames)
{
    const double begin = seconds();
    for (int i = 0; i < 2; i++)
    {
        const pid_t child = fork();
        need(child >= 0);
        if (child == 0)
        {
            make_frames(of, options, frames, NULL);
            _exit(0);
        }
    }
    for (int i = 0; i < 2; i++)
    {
        int status = 0;
        need(wait(&status) > 0 && status == 0);
    }
    return seconds() - begin;
}

/* Threads are made anew: a process that has some may not be copied. */
static double by_threads(const stage *of, const cm_tof_options *options, int frames)
{
    cm_pool *pool = NULL;
    need(cm_pool_create(2, &pool) == CM_OK);
    const double begin = seconds();
    make_frames(of, options, 2 * frames, pool);
    const double took = seconds() - begin;
    cm_pool_destroy(pool);
    return took;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
    const int asked = argc > 1 ? atoi(argv[1]) : 15, frames = argc > 2 ? atoi(argv[2]) : 10;
    const int rounds = asked < 1 ? 1 : asked < ROUNDS_MOST ? asked : ROUNDS_MOST;
    const stage at = make_stage();
    static const struct
    {
        const char *name;
        cm_tof_options options;
    } settings[] = {
        {"direct", {.size = sizeof(cm_tof_options)}},
        {"direct, noise", {.size = sizeof(cm_tof_options), .noise = 1}},
        {"3 x 3, adaptive",
         {.size = sizeof(cm_tof_options), .sample_columns = 3, .sample_rows = 3}},
        {"338 virtual lights", {.size = sizeof(cm_tof_options), .bounces = 1}},
    };
    for (size_t s = 0; s < sizeof settings / sizeof *settings; s++)
    {
        double quotient[ROUNDS_MOST];
        const cm_tof_options *options = &settings[s].options;
        make_frames(&at, options, 1, NULL);
        for (int i = 0; i < rounds; i++)
        {
            const double processes = by_processes(&at, options, frames);
            quotient[i] = processes / by_threads(&at, options, frames);
        }
        qsort(quotient, (size_t)rounds, sizeof *quotient, compare);
        printf("%-20s two threads make %.3f of the frames of two processes, %.3f to %.3f\n",
               settings[s].name, quotient[rounds / 2], quotient[rounds / 4],
               quotient[3 * rounds / 4]);
    }
    return 0;
}
