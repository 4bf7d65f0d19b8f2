/* SPDX-License-Identifier: MIT
 *
 * What a frame of 640 x 480 pixels in the analytic room costs, by one thread, ms of the processor, best and median of several
 * runs: four phases and the result, with one sample a pixel, with 3 x 3 of them where they are needed and everywhere; and how
 * far those two are apart.
 *
 *   simulate-speed [RUNS [ONE]]     ONE: the number of the only line wanted, from 0
 */
#include "bench/harness/harness.h"
#include "room_stage.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define RUNS_MOST 101

static float phase[PHASES * PIXELS], distance[2][PIXELS], amplitude[PIXELS], intensity[PIXELS];

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

typedef struct setting
{
    const char *name;
    cm_tof_options options;
} setting;

static void measure(const room_stage *stage, const setting *with, int runs, float *result)
{
    double milliseconds[RUNS_MOST];
    cm_tof_report report = {.size = sizeof report};
    for (int i = 0; i < runs; i++)
    {
        cm_tof_result to = {.size = sizeof to,
                            .phase = phase,
                            .distance = result,
                            .amplitude = amplitude,
                            .intensity = intensity,
                            .report = &report};
        const clock_t begin = clock();
        room_stage_simulate(stage, &with->options, NULL, &to);
        milliseconds[i] = 1e3 * (double)(clock() - begin) / CLOCKS_PER_SEC;
    }
    qsort(milliseconds, (size_t)runs, sizeof *milliseconds, compare);
    printf("%-24s %8.2f %8.2f  %9.0f rays, %7.0f pixels with all samples\n", with->name,
           milliseconds[0], milliseconds[runs / 2], (double)report.rays,
           (double)report.oversampled);
}

int main(int argc, char **argv)
{
    const int runs = argc > 1 ? atoi(argv[1]) : 15;
    room_stage stage = room_stage_make();
    const setting settings[] = {
        {"direct", {.size = sizeof(cm_tof_options)}},
        {"direct, noise", {.size = sizeof(cm_tof_options), .noise = 1}},
        {"3 x 3, adaptive",
         {.size = sizeof(cm_tof_options), .sample_columns = 3, .sample_rows = 3}},
        {"3 x 3, full",
         {.size = sizeof(cm_tof_options), .sample_columns = 3, .sample_rows = 3, .full = 1}},
    };
    const int only = argc > 2 ? atoi(argv[2]) : -1;
    for (int i = 0; i < 4; i++)
    {
        if (only >= 0 && i != only)
        {
            continue;
        }
        measure(&stage, &settings[i], runs < RUNS_MOST ? runs : RUNS_MOST, distance[i == 3]);
    }
    double most = 0.0;
    size_t apart = 0;
    for (size_t i = 0; i < PIXELS; i++)
    {
        const double difference = fabs((double)distance[0][i] - (double)distance[1][i]);
        most = fmax(most, difference);
        apart += difference > 1e-4;
    }
    printf("adaptive and full: %.3g m apart at the most, %zu pixels by more than 0.1 mm\n", most,
           apart);
    room_stage_free(&stage);
    return 0;
}
