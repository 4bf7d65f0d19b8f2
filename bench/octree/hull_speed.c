/* SPDX-License-Identifier: MIT
 *
 * What a visual hull costs: seven masks of 1024 x 768 pixels around a body of some 300 x 300 x 200 voxels, the sizes of Orman
 * and others, GPU-Based Optimization of a Free-Viewpoint Video System, Table 1 (23 148 ms on a processor, 179.8 ms on a graphics
 * card of 2008). The map around it has 512^3 voxels, all of which are carved. Best and median of many runs, ms of the clock
 * and of the processor, by one thread and by as many as there are.
 *
 *   hull-speed
 */
#include "bench/harness/harness.h"
#include "mapped_room.h"

#include <cubemap/world.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    VIEWS = 7,
    WIDTH = 1024,
    HEIGHT = 768,
    RUNS = 9
};

static uint8_t mask[VIEWS][WIDTH * HEIGHT];

/* A man with his arms out, 300 high and wide if an edge is 1. */
static cm_scene *make_body(void)
{
    /* from, to, radius */
    static const double part[][7] = {
        {-25, 0, -148, -18, 0, -20, 22}, {25, 0, -148, 18, 0, -20, 22}, {0, 0, -30, 0, 0, 90, 45},
        {-40, 0, 75, -138, 30, 60, 14},  {40, 0, 75, 138, -30, 60, 14},
    };
    cm_scene *scene = NULL;
    cm_scene_create(&scene);
    for (size_t i = 0; i < sizeof part / sizeof *part; i++)
    {
        cm_primitive p = {.size = sizeof p, .kind = CM_PRIMITIVE_CYLINDER, .radius = part[i][6]};
        memcpy(p.first, part[i], sizeof p.first);
        memcpy(p.second, part[i] + 3, sizeof p.second);
        cm_scene_add(scene, &p, NULL);
    }
    const cm_primitive head = {
        .size = sizeof head, .kind = CM_PRIMITIVE_SPHERE, .first = {0, 0, 118}, .radius = 30};
    cm_scene_add(scene, &head, NULL);
    return scene;
}

/* On a circle around, from a little above. */
static void place(cm_pose *pose, int which)
{
    const double angle = 2.0 * 3.14159265358979 * which / VIEWS, range = 520.0, up = 120.0;
    *pose = pose_towards((const double[3]){range * cos(angle), range * sin(angle), up},
                         (const double[3]){0.0, 0.0, 0.0});
}

static void draw_mask(const cm_scene *scene, const cm_camera *camera, const cm_pose *pose,
                      uint8_t *pixel)
{
    static double d[6][WIDTH], column[WIDTH], row[WIDTH], distance[WIDTH];
    static uint32_t id[WIDTH];
    for (size_t r = 0; r < HEIGHT; r++)
    {
        for (size_t i = 0; i < WIDTH; i++)
        {
            column[i] = (double)i;
            row[i] = (double)r;
        }
        cm_camera_ray_array(camera, WIDTH, column, row, d[0], d[1], d[2]);
        for (size_t i = 0; i < WIDTH; i++)
        {
            const double ray[3] = {d[0][i], d[1][i], d[2][i]};
            for (size_t k = 0; k < 3; k++)
            {
                d[k][i] = pose->rotation.row[0][k] * ray[0] + pose->rotation.row[1][k] * ray[1] +
                          pose->rotation.row[2][k] * ray[2];
                d[3 + k][i] = pose->position[k];
            }
        }
        const cm_hit_arrays hit = {.size = sizeof hit, .distance = distance, .id = id};
        cm_scene_cast_array(scene, WIDTH, d[3], d[4], d[5], d[0], d[1], d[2], &hit);
        for (size_t i = 0; i < WIDTH; i++)
        {
            pixel[r * WIDTH + i] = id[i] == CM_SCENE_NOTHING ? 0 : 255;
        }
    }
}

static void report(const cm_view *views, cm_pool *pool, int levels, int outside_survives)
{
    double took[RUNS], worked[RUNS];
    size_t occupied = 0;
    for (int i = 0; i < RUNS; i++)
    {
        const cm_octree_options options = {.size = sizeof options, .edge = 1.0, .levels = levels};
        cm_octree *octree = NULL;
        cm_octree_create(&options, &octree);
        const double begin = seconds(), work = processor_seconds();
        const cm_status status = cm_hull_carve(octree, VIEWS, views, outside_survives, pool);
        took[i] = seconds() - begin;
        worked[i] = processor_seconds() - work;
        if (status != CM_OK)
        {
            fprintf(stderr, "hull-speed: %s\n", cm_status_text(status));
            exit(1);
        }
        cm_octree_count count = {.size = sizeof count};
        cm_octree_count_voxels(octree, &count);
        occupied = (size_t)count.occupied;
        cm_octree_destroy(octree);
    }
    const timing t = summary(took, RUNS), w = summary(worked, RUNS);
    printf("  %d^3, outside %s, %u thread%s  %7.1f  %7.1f  processor %7.1f  occupied %zu\n",
           1 << levels, outside_survives ? "survives" : "dies", cm_pool_threads(pool),
           cm_pool_threads(pool) == 1 ? " " : "s", 1e3 * t.best, 1e3 * t.median, 1e3 * w.best,
           occupied);
}

int main(void)
{
    name_program("hull-speed");
    const cm_camera_options lens = {.size = sizeof lens,
                                    .width = WIDTH,
                                    .height = HEIGHT,
                                    .fx = 1150,
                                    .fy = 1150,
                                    .cx = 511.5,
                                    .cy = 383.5};
    cm_camera *camera = NULL;
    cm_view views[VIEWS];
    cm_pool *pool = NULL;
    cm_scene *scene = make_body();
    if (cm_camera_create(&lens, &camera) != CM_OK || cm_pool_create(0, &pool) != CM_OK)
    {
        return 1;
    }
    for (int i = 0; i < VIEWS; i++)
    {
        views[i] = (cm_view){.size = sizeof views[i],
                             .camera = camera,
                             .color = {.size = sizeof(cm_image),
                                       .data = mask[i],
                                       .type = CM_PIXEL_U8,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .channels = 1}};
        place(&views[i].pose, i);
        draw_mask(scene, camera, &views[i].pose, mask[i]);
    }
    printf("%s\n  ms: best, median\n", system_cpu());
    for (int survives = 0; survives < 2; survives++)
    {
        report(views, NULL, 9, survives);
        report(views, pool, 9, survives);
    }
    cm_pool_destroy(pool);
    cm_camera_destroy(camera);
    cm_scene_destroy(scene);
    return close_standard_output();
}
