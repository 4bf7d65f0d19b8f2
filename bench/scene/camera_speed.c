/* SPDX-License-Identifier: MIT
 *
 * What a picture of 640 x 480 costs through a camera on one core, beside its target and the machine's memcpy: every pixel to
 * its ray, every ray to its pixel. The median and the best of many runs, in time of the processor, and the largest residual
 * of them, in pixels.
 *
 *   camera-speed
 */
#include "bench/harness/harness.h"

#include <cubemap/camera.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    WIDTH = 640,
    HEIGHT = 480,
    PIXELS = WIDTH * HEIGHT,
    RUNS = 11
};

static double column[PIXELS], row[PIXELS], x[PIXELS], y[PIXELS], z[PIXELS], right[PIXELS],
    down[PIXELS];

static int earlier(const void *a, const void *b)
{
    const double one = *(const double *)a;
    const double other = *(const double *)b;
    return (one > other) - (one < other);
}

typedef void work(const cm_camera *camera);

static void rays(const cm_camera *camera)
{
    cm_camera_ray_array(camera, PIXELS, column, row, x, y, z);
}

static void points(const cm_camera *camera)
{
    cm_camera_project_array(camera, PIXELS, x, y, z, right, down);
}

static void copies(const cm_camera *camera)
{
    (void)camera;
    memcpy(right, column, sizeof right);
}

static void report(const char *name, work *run, const cm_camera *camera, const char *target)
{
    double took[RUNS];
    for (int i = 0; i < RUNS; i++)
    {
        const double begin = processor_seconds();
        run(camera);
        took[i] = 1e3 * (processor_seconds() - begin);
    }
    qsort(took, RUNS, sizeof *took, earlier);
    printf("%-34s %8.3f ms, best %8.3f ms%s\n", name, took[RUNS / 2], took[0], target);
}

static void report_residual(void)
{
    double worst = 0.0;
    int missing = 0;
    for (int i = 0; i < PIXELS; i++)
    {
        const double off = fmax(fabs(right[i] - column[i]), fabs(down[i] - row[i]));
        missing += isnan(right[i]) ? 1 : 0;
        worst = off > worst ? off : worst;
    }
    printf("%-34s %8.2g pixels; %d pixels have no ray\n", "  residual", worst, missing);
}

static void report_camera(const char *name, const cm_camera_options *options)
{
    cm_camera *camera = NULL;
    double best = 1e9;
    for (int i = 0; i < RUNS; i++)
    {
        cm_camera_destroy(camera);
        const double begin = processor_seconds();
        if (cm_camera_create(options, &camera) != CM_OK)
        {
            printf("%s: no camera\n", name);
            return;
        }
        const double took = processor_seconds() - begin;
        best = took < best ? took : best;
    }
    printf("%s: created in %.3f ms\n", name, 1e3 * best);
    report("  inverse (cm_camera_ray_array)", rays, camera, ", target 12 ms");
    report("  forward (cm_camera_project_array)", points, camera, ", target 3 ms");
    report_residual();
    cm_camera_destroy(camera);
}

int main(void)
{
    name_program("camera-speed");
    cm_camera_options options = {.size = sizeof options,
                                 .width = WIDTH,
                                 .height = HEIGHT,
                                 .fx = 525.0,
                                 .fy = 525.0,
                                 .cx = 319.5,
                                 .cy = 239.5};
    for (int i = 0; i < PIXELS; i++)
    {
        column[i] = i % WIDTH;
        row[i] = (double)(i / WIDTH);
    }
    printf("640 x 480, one core, %s\n", system_cpu());
    report("memcpy of 2.4 MB", copies, NULL, "");
    report_camera("no distortion", &options);
    const double all[14] = {-0.28, 0.12, 1e-3,  -2e-3, 0.02, 0.05, -0.02,
                            0.01,  1e-3, -5e-4, 1e-3,  2e-4, 0.01, -0.02};
    memcpy(options.distortion, all, sizeof all);
    report_camera("14 coefficients", &options);
    const double folds[14] = {-0.9, 0.0, 1e-3, 1e-3};
    memcpy(options.distortion, folds, sizeof folds);
    report_camera("folds inside the picture", &options);
    const double bent[14] = {-0.6, 0.3, 0.05, -0.1, 0.0, 0.0, 0.0, 0.0, 0.1, -0.05, 0.05, 0.0};
    memcpy(options.distortion, bent, sizeof bent);
    report_camera("folds to one side", &options);
    return 0;
}
