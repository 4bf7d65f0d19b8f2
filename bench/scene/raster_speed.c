/* SPDX-License-Identifier: MIT
 *
 * What 300 000 discs three pixels across cost on one core, into 640 x 480 pixels, beside their target and the machine's
 * memcpy; and as many points, and triangles of a few pixels. By instruction set the best and the median of many runs, in ms of the processor.
 *
 *   raster-speed
 */
#include "bench/harness/harness.h"

#include <cubemap/options.h>
#include <cubemap/raster.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    WIDTH = 640,
    HEIGHT = 480,
    PIXELS = WIDTH * HEIGHT,
    COUNT = 300000,
    TRIANGLES = COUNT / 3,
    RUNS = 15
};

static float number[7][COUNT], image[PIXELS], other[PIXELS];
static double position[COUNT][3];
static uint32_t id[PIXELS];

typedef void work(cm_raster *raster);

static double fraction(void)
{
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return (double)(state >> 8) * 0x1p-24;
}

static void copy(cm_raster *raster)
{
    (void)raster;
    memcpy(other, image, sizeof other);
    image[0] += other[PIXELS - 1]; /* lest it be left out */
}

static void draw_discs(cm_raster *raster)
{
    const cm_discs discs = {.size = sizeof discs,
                            .count = COUNT,
                            .centre = {number[0], number[1], number[2]},
                            .normal = {number[3], number[4], number[5]},
                            .radius = number[6]};
    cm_raster_clear(raster);
    cm_raster_discs(raster, NULL, &discs, 1);
}

static void draw_points(cm_raster *raster)
{
    const cm_points points = {.size = sizeof points, .count = COUNT, .position = position[0]};
    cm_raster_clear(raster);
    cm_raster_points(raster, NULL, &points, 1);
}

static void draw_triangles(cm_raster *raster)
{
    const cm_triangles triangles = {.size = sizeof triangles,
                                    .vertex_count = COUNT,
                                    .position = position[0],
                                    .triangle_count = TRIANGLES};
    cm_raster_clear(raster);
    cm_raster_triangles(raster, NULL, &triangles, 1);
}

static void read_all(cm_raster *raster)
{
    cm_raster_read(raster, image, id);
}

static void report(const char *name, work *run, cm_raster *raster, const char *target)
{
    double took[RUNS];
    for (int i = 0; i < RUNS; i++)
    {
        const double begin = processor_seconds();
        run(raster);
        took[i] = processor_seconds() - begin;
    }
    const timing t = summary(took, RUNS);
    printf("  %-26s %7.3f  %7.3f  %s\n", name, 1e3 * t.best, 1e3 * t.median, target);
}

/* In the order of an image's pixels, or anywhere in the picture, at 1 to 4 m, looking to the camera to within a quarter of a turn. */
static void fill(const cm_camera_options *options, int is_in_order)
{
    for (size_t i = 0; i < COUNT; i++)
    {
        const double z = 1.0 + 3.0 * fraction();
        const double column = is_in_order ? (double)(i % WIDTH) : WIDTH * fraction();
        const double row = is_in_order ? (double)(i / WIDTH) : HEIGHT * fraction();
        const double x = (column - options->cx) / options->fx;
        const double y = (row - options->cy) / options->fy;
        number[0][i] = (float)(x * z);
        number[1][i] = (float)(y * z);
        number[2][i] = (float)z;
        number[3][i] = (float)(fraction() - 0.5);
        number[4][i] = (float)(fraction() - 0.5);
        number[5][i] = -0.5f;
        number[6][i] = (float)(1.5 * z / options->fx);
        const double *first = position[i - i % 3];
        position[i][0] = i % 3 == 0 ? x * z : first[0] + 0.02 * (fraction() - 0.5);
        position[i][1] = i % 3 == 0 ? y * z : first[1] + 0.02 * (fraction() - 0.5);
        position[i][2] = i % 3 == 0 ? z : first[2];
    }
}

int main(void)
{
    name_program("raster-speed");
    cm_camera *camera = NULL;
    const cm_camera_options options = {.size = sizeof options,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .fx = 525.0,
                                       .fy = 525.0,
                                       .cx = 319.5,
                                       .cy = 239.5};
    if (cm_camera_create(&options, &camera) != CM_OK)
    {
        return EXIT_FAILURE;
    }
    printf("%s\n%-28s %7s  %7s  target, ms\n", system_cpu(), "", "best", "median");
    report("memcpy of an image", copy, NULL, "");
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        cm_raster *raster = NULL;
        if (cm_raster_create(camera, 0.0, cm_instructions_at(i), &raster) != CM_OK)
        {
            return EXIT_FAILURE;
        }
        printf("%s\n", cm_instructions_at(i));
        fill(&options, 1);
        report("300 000 discs, as pixels", draw_discs, raster, "10");
        report("100 000 triangles, so", draw_triangles, raster, "");
        fill(&options, 0);
        report("300 000 discs, anywhere", draw_discs, raster, "10");
        report("300 000 points", draw_points, raster, "");
        report("100 000 triangles", draw_triangles, raster, "");
        report("read", read_all, raster, "");
        cm_raster_destroy(raster);
    }
    cm_camera_destroy(camera);
    return close_standard_output();
}
