/* SPDX-License-Identifier: MIT
 *
 * What a depth image of 640 x 480 costs on one core, beside its target and the machine's memcpy: by instruction set the
 * best and the median of many runs, in ms of the processor.
 *
 *   depth-speed
 */
#include "bench/harness/harness.h"

#include <cubemap/depth.h>
#include <cubemap/options.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    WIDTH = 640,
    HEIGHT = 480,
    PIXELS = WIDTH * HEIGHT,
    RUNS = 41
};

static uint16_t stored[PIXELS];
static float depth[PIXELS], other[PIXELS],
    planes[7][PIXELS + 48]; /* not at the same place of pages */

/* What is timed. */
typedef struct subject
{
    cm_rays *rays;
    cm_depth_pyramid *pyramid;
} subject;

typedef void work(const subject *s);

static void copy(const subject *s)
{
    (void)s;
    memcpy(other, depth, sizeof other);
}

/* What a map of vertices and normals has to write, and no more. */
static void write_planes(const subject *s)
{
    (void)s;
    for (size_t row = 0; row < HEIGHT; row++)
    {
        for (size_t k = 0; k < 6; k++)
        {
            memset(planes[k] + row * WIDTH, (int)row, WIDTH * sizeof **planes);
        }
    }
}

static void clean(const subject *s)
{
    const cm_image picture = {.size = sizeof picture,
                              .data = stored,
                              .type = CM_PIXEL_U16,
                              .width = WIDTH,
                              .height = HEIGHT,
                              .channels = 1};
    const cm_depth_limits limits = {.size = sizeof limits, .unit = 1.0 / 5000.0};
    (void)s;
    cm_depth_clean(&picture, &limits, 1, other, NULL);
}

static void map(const subject *s)
{
    const cm_depth_maps maps = {.size = sizeof maps,
                                .vertex = {planes[0], planes[1], planes[2]},
                                .normal = {planes[3], planes[4], planes[5]}};
    cm_depth_make_maps(s->rays, depth, 1, &maps);
}

static void fill(const subject *s)
{
    cm_depth_pyramid_fill(s->pyramid, depth, 1);
}

static void smooth(const subject *s)
{
    cm_depth_smooth(s->rays, depth, 2.0, 0.03, 1, other);
}

static void halve(const subject *s)
{
    cm_depth_halve(s->rays, depth, 0.03, 1, other);
}

static void report(const char *name, work *run, const subject *s, const char *target)
{
    double took[RUNS];
    for (int i = 0; i < RUNS; i++)
    {
        const double begin = processor_seconds();
        run(s);
        took[i] = processor_seconds() - begin;
    }
    const timing t = summary(took, RUNS);
    printf("  %-22s %7.3f  %7.3f  %s\n", name, 1e3 * t.best, 1e3 * t.median, target);
}

static void report_set(const cm_camera *camera, const char *set)
{
    subject s = {0};
    if (cm_rays_create(camera, set, &s.rays) != CM_OK ||
        cm_depth_pyramid_create(WIDTH, HEIGHT, set, &s.pyramid) != CM_OK)
    {
        fprintf(stderr, "%s: no memory\n", program_name());
        exit(EXIT_FAILURE);
    }
    printf("%s\n", set);
    report("vertices and normals", map, &s, "0.5");
    report("min/max pyramid", fill, &s, "0.5");
    report("bilateral 7x7", smooth, &s, "3");
    report("halve", halve, &s, "");
    cm_depth_pyramid_destroy(s.pyramid);
    cm_rays_destroy(s.rays);
}

int main(void)
{
    name_program("depth-speed");
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
    for (size_t i = 0; i < PIXELS; i++)
    {
        const unsigned noise = (unsigned)(i * 2654435761u) >> 26;
        stored[i] = (uint16_t)(i % 37 == 0 ? 0 : 5000 + noise + (i % WIDTH > 300 ? 3000 : 0));
        depth[i] = (float)stored[i] / 5000.0f;
    }
    printf("%s\n%-24s %7s  %7s  target, ms\n", system_cpu(), "", "best", "median");
    report("memcpy of an image", copy, NULL, "");
    report("memset of six planes", write_planes, NULL, "");
    report("clean 16 bits, any set", clean, NULL, "");
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        report_set(camera, cm_instructions_at(i));
    }
    cm_camera_destroy(camera);
    return close_standard_output();
}
