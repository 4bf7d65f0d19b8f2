/* SPDX-License-Identifier: MIT
 *
 * What scattered light costs: virtual lights over the places of a picture of 640 x 480 pixels in the analytic room, without and
 * with shadows, ms of the processor, best of several runs, and thousand millions of pairs a second; paths beside them. And how
 * far distances by lights are from those by paths of one bounce, in a corner of three walls: millimetres, root mean square and
 * median, and what no scattered light at all would be off.
 *
 *   multipath-speed [RUNS [MAPPING]]     MAPPING: of maps and shadows; else healpix, tangent and algebraic
 */
#include "bench/harness/harness.h"

#include "modules/sim/tof_object.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define PI 3.14159265358979323846

enum
{
    WIDTH = 640,
    HEIGHT = 480,
    PIXELS = WIDTH * HEIGHT,
    BLOCK = 256 /* places that a picture hands over at once */
};

static double position[3][PIXELS], normal[3][PIXELS], way[3][PIXELS], origin[3][PIXELS];
static double range[PIXELS], total[PIXELS], part_real[PIXELS], part_imaginary[PIXELS],
    ambient[PIXELS];
static double by_paths[2][PIXELS];
static uint32_t id[PIXELS], number[PIXELS];

static void need(cm_status status)
{
    if (status != CM_OK)
    {
        fprintf(stderr, "multipath-speed: %s\n", cm_status_text(status));
        exit(1);
    }
}

static double milliseconds_since(clock_t begin)
{
    return 1e3 * (double)(clock() - begin) / CLOCKS_PER_SEC;
}

/* What a camera with an opening of 62 degrees sees from a place along a direction in the level plane; z is up. */
static void look(const tof_instant *instant, const double from[3], double azimuth, double pitch)
{
    const double *const begin[3] = {origin[0], origin[1], origin[2]};
    const double *const to[3] = {way[0], way[1], way[2]};
    const tof_hits hits = {
        .distance = range, .id = id, .normal = {normal[0], normal[1], normal[2]}};
    for (int i = 0; i < PIXELS; i++)
    {
        const double x = (i % WIDTH + 0.5 - WIDTH / 2) / 525.0;
        const double y = (i / WIDTH + 0.5 - HEIGHT / 2) / 525.0;
        const double length = sqrt(1.0 + x * x + y * y);
        const double level = cos(pitch) + y * sin(pitch);
        way[0][i] = (cos(azimuth) * level + sin(azimuth) * x) / length;
        way[1][i] = (sin(azimuth) * level - cos(azimuth) * x) / length;
        way[2][i] = (sin(pitch) - y * cos(pitch)) / length;
        for (int k = 0; k < 3; k++)
        {
            origin[k][i] = from[k];
        }
        number[i] = (uint32_t)i;
    }
    tof_cast(instant, PIXELS, begin, to, &hits);
    for (int k = 0; k < 3; k++)
    {
        for (int i = 0; i < PIXELS; i++)
        {
            if (id[i] == CM_SCENE_NOTHING)
            {
                fprintf(stderr, "multipath-speed: the camera sees nothing\n");
                exit(1);
            }
            position[k][i] = from[k] + range[i] * way[k][i];
            way[k][i] = -way[k][i];
        }
    }
}

typedef struct setting
{
    const tof_instant *instant;
    tof_lamp lamp;
    tof_waves waves;
} setting;

/* Every step-th place; by paths, or by lights (made before). */
static void add(const setting *s, const cm_tof_options *options, const tof_virtual_lights *lights,
                size_t n)
{
    for (size_t i = 0; i < PIXELS; i++)
    {
        total[i] = part_real[i] = part_imaginary[i] = 0.0;
    }
    for (size_t at = 0; at < n; at += BLOCK)
    {
        const tof_points points = {n - at < BLOCK ? n - at : BLOCK,
                                   {position[0] + at, position[1] + at, position[2] + at},
                                   {normal[0] + at, normal[1] + at, normal[2] + at},
                                   {way[0] + at, way[1] + at, way[2] + at},
                                   range + at,
                                   id + at,
                                   number + at};
        tof_radiance to = {total + at, part_real + at, part_imaginary + at, ambient + at};
        need(lights != NULL
                 ? tof_virtual_lights_add(lights, &points, &to)
                 : tof_paths_add(s->instant, &s->lamp, 1, options, &s->waves, &points, &to));
    }
}

static void time_lights(const setting *s, const char *name, int visibility, int runs)
{
    cm_mapping *mapping = NULL;
    double best[2] = {INFINITY, INFINITY};
    need(cm_mapping_create(name, NULL, &mapping));
    const cm_tof_options options = {
        .size = sizeof options, .visibility = visibility, .mapping = mapping};
    for (int i = 0; i < runs; i++)
    {
        tof_virtual_lights *lights = NULL;
        const clock_t begin = clock();
        need(
            tof_virtual_lights_create(s->instant, &s->lamp, 1, &options, &s->waves, NULL, &lights));
        best[0] = fmin(best[0], milliseconds_since(begin));
        const clock_t made = clock();
        add(s, &options, lights, PIXELS);
        best[1] = fmin(best[1], milliseconds_since(made));
        tof_virtual_lights_destroy(lights);
    }
    printf("%-12s 338 lights %-15s made %7.2f ms, gathered %7.2f ms, %5.2f G pairs/s\n", name,
           visibility ? "with shadows" : "without shadows", best[0], best[1],
           338e-6 * PIXELS / best[1]);
    cm_mapping_destroy(mapping);
}

static void time_paths(const setting *s, int runs)
{
    enum
    {
        SOME = PIXELS / 16
    };
    const cm_tof_options options = {.size = sizeof options, .bounces = 1, .paths = 64};
    double best = INFINITY;
    for (int i = 0; i < runs; i++)
    {
        const clock_t begin = clock();
        add(s, &options, NULL, SOME);
        best = fmin(best, milliseconds_since(begin));
    }
    printf("%-12s 64 paths of one bounce, of every 16th pixel: %.2f ms, %.2f M rays/s\n", "", best,
           2.0 * 64 * SOME / best / 1e3);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Metres, of direct light and this. */
static double distance_with(const setting *s, size_t i, double real, double imaginary)
{
    double square = 0.0;
    double cosine = 0.0;
    for (int k = 0; k < 3; k++)
    {
        const double d = s->lamp.position[k] - position[k][i];
        square += d * d;
        cosine += d * normal[k][i];
    }
    const double radiance =
        tof_instant_surfaces(s->instant)[id[i]].reflectance / PI * cosine / (square * sqrt(square));
    const double phase = s->waves.number[0] * (sqrt(square) + range[i]);
    const double turned = atan2(radiance * sin(phase) + imaginary, radiance * cos(phase) + real);
    return turned / (2.0 * s->waves.number[0]);
}

static void compare_in_corner(void)
{
    static double apart[PIXELS];
    static const uint32_t counts[] = {338, 1000, 4000};
    static const double from[3] = {1.5, 1.4, 1.3};
    const cm_primitive box = {.size = sizeof box,
                              .kind = CM_PRIMITIVE_BOX,
                              .second = {4, 4, 4},
                              .material = {{1, 1, 1}, .reflectance = 0.6}};
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    tof_instant *instant = NULL;
    need(cm_scene_create(&world));
    need(cm_scene_add(world, &box, NULL));
    need(cm_tof_scene_create(world, &scene));
    need(tof_instant_create(scene, 0.0, &instant));
    look(instant, from, -0.76 * PI, -0.6);
    /* Every 40th pixel to the front. */
    const size_t n = PIXELS / 40;
    for (size_t i = 0; i < n; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            position[k][i] = position[k][40 * i + 17];
            normal[k][i] = normal[k][40 * i + 17];
            way[k][i] = way[k][40 * i + 17];
        }
        range[i] = range[40 * i + 17];
        id[i] = id[40 * i + 17];
    }
    /* A cone towards the corner: half of it is dark elsewhere. */
    const setting s = {instant,
                       {.position = {1.5, 1.4, 1.32},
                        .axis = {-0.6, -0.56, -0.5713},
                        .least_cosine = 0.7,
                        .part = 0.15,
                        .intensity = 1.0},
                       {1, {2.0 * PI * 20e6 / CM_SPEED_OF_LIGHT}}};
    const cm_tof_options traced = {
        .size = sizeof traced, .bounces = 1, .traces = 1, .paths = 4096, .seed = 1};
    add(&s, &traced, NULL, n);
    double square = 0.0;
    for (size_t i = 0; i < n; i++)
    {
        by_paths[0][i] = part_real[i];
        by_paths[1][i] = part_imaginary[i];
        const double d =
            distance_with(&s, i, part_real[i], part_imaginary[i]) - distance_with(&s, i, 0.0, 0.0);
        square += d * d;
    }
    printf("corner       without scattered light %.3f mm\n", 1e3 * sqrt(square / (double)n));
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
    {
        tof_virtual_lights *lights = NULL;
        const cm_tof_options options = {.size = sizeof options, .lights = counts[c]};
        need(tof_virtual_lights_create(instant, &s.lamp, 1, &options, &s.waves, NULL, &lights));
        add(&s, &options, lights, n);
        tof_virtual_lights_destroy(lights);
        square = 0.0;
        for (size_t i = 0; i < n; i++)
        {
            const double d = distance_with(&s, i, part_real[i], part_imaginary[i]) -
                             distance_with(&s, i, by_paths[0][i], by_paths[1][i]);
            apart[i] = fabs(d);
            square += d * d;
        }
        qsort(apart, n, sizeof *apart, compare);
        printf("corner       %4u lights %.3f mm, median %.3f mm\n", (unsigned)counts[c],
               1e3 * sqrt(square / (double)n), 1e3 * apart[n / 2]);
    }
    tof_instant_destroy(instant);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
}

int main(int argc, char **argv)
{
    static const char *const mappings[] = {"healpix", "tangent", "algebraic"};
    static const double from[3] = {-2.0, 0.3, 1.4};
    const int runs = argc > 1 ? atoi(argv[1]) : 5;
    cm_scene *world = NULL;
    cm_tof_scene *scene = NULL;
    tof_instant *instant = NULL;
    need(cm_scene_create_named("room", &world));
    need(cm_tof_scene_create(world, &scene));
    need(tof_instant_create(scene, 0.0, &instant));
    look(instant, from, 0.0, 0.0);
    const setting s = {instant,
                       {.position = {-2.0, 0.35, 1.4},
                        .axis = {1, 0, 0},
                        .least_cosine = -1.0,
                        .part = 1.0,
                        .intensity = 1.0},
                       {1, {2.0 * PI * 20e6 / CM_SPEED_OF_LIGHT}}};
    for (size_t i = 0; i < (argc > 2 ? 1 : sizeof mappings / sizeof *mappings); i++)
    {
        for (int visibility = 0; visibility < 2; visibility++)
        {
            time_lights(&s, argc > 2 ? argv[2] : mappings[i], visibility, runs);
        }
    }
    time_paths(&s, runs);
    tof_instant_destroy(instant);
    cm_tof_scene_destroy(scene);
    cm_scene_destroy(world);
    compare_in_corner();
    return 0;
}
