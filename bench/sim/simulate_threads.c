/* SPDX-License-Identifier: MIT
 *
 * Frames a second of two threads of one process beside those of two processes with a thread each, 640 x 480 pixels in the analytic
 * room: both take turns in rounds, and the median of the rounds' quotients counts, which what else the machine does changes least.
 *
 *   simulate-threads [ROUNDS [FRAMES]]
 */
#define _POSIX_C_SOURCE 200809L

#include "room_stage.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define ROUNDS_MOST 1001

static float phase[PHASES * PIXELS], distance[PIXELS], amplitude[PIXELS], intensity[PIXELS];

static void make_frames(const room_stage *of, const cm_tof_options *options, int frames,
                        cm_pool *pool)
{
    for (int i = 0; i < frames; i++)
    {
        cm_tof_result to = {.size = sizeof to,
                            .phase = phase,
                            .distance = distance,
                            .amplitude = amplitude,
                            .intensity = intensity};
        room_stage_simulate(of, options, pool, &to);
    }
}

static void need_process(int is_good)
{
    if (!is_good)
    {
        fputs("simulate-threads: a process failed\n", stderr);
        exit(1);
    }
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Seconds until two processes have made so many frames each. */
static double by_processes(const room_stage *of, const cm_tof_options *options, int frames)
{
    const double begin = seconds();
    for (int i = 0; i < 2; i++)
    {
        const pid_t child = fork();
        need_process(child >= 0);
        if (child == 0)
        {
            make_frames(of, options, frames, NULL);
            _exit(0);
        }
    }
    for (int i = 0; i < 2; i++)
    {
        int status = 0;
        need_process(wait(&status) > 0 && status == 0);
    }
    return seconds() - begin;
}

/* Threads are made anew: a process that has some may not be copied. */
static double by_threads(const room_stage *of, const cm_tof_options *options, int frames)
{
    cm_pool *pool = NULL;
    need(cm_pool_create(2, &pool));
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
    room_stage at = room_stage_make();
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
    room_stage_free(&at);
    return 0;
}
