/* SPDX-License-Identifier: MIT
 *
 * Rays through a map of the analytic room, by one thread: those of pictures of 640 x 480, row by row from the poses of the walk, and
 * random ones, from places in the air of the room in all directions. Millions a second of the processor, best and median of many
 * runs; and the mean distance of what is met, so that a run can be compared with another.
 *
 *   ray-speed [EDGE [RUNS]]     0.01 m, 15 runs
 */
#include "bench/harness/harness.h"
#include "mapped_room.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum
{
    RAYS = 65536
};

typedef struct ray
{
    double origin[3];
    double direction[3];
} ray;

/* Pixels of one picture in their order, as many rows as there are rays for. */
static void draw_picture(const room_walk *walk, size_t view, ray *rays)
{
    const cm_pose *pose = &walk->view[view].pose;
    for (size_t i = 0; i < RAYS; i++)
    {
        const double column = (double)(i % ROOM_WIDTH);
        const double row = (double)(i / ROOM_WIDTH + (ROOM_HEIGHT - RAYS / ROOM_WIDTH) / 2);
        double to[3];
        cm_camera_ray_array(walk->camera, 1, &column, &row, to, to + 1, to + 2);
        for (int k = 0; k < 3; k++)
        {
            rays[i].origin[k] = pose->position[k];
            rays[i].direction[k] = pose->rotation.row[0][k] * to[0] +
                                   pose->rotation.row[1][k] * to[1] +
                                   pose->rotation.row[2][k] * to[2];
        }
    }
}

static double draw(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static void draw_random(const cm_octree *octree, ray *rays)
{
    static const double size[3] = {5.8, 4.8, 2.8}, low[3] = {-2.9, -2.4, 0.1};
    uint64_t state = 1;
    for (size_t i = 0; i < RAYS; i++)
    {
        do
        {
            for (int k = 0; k < 3; k++)
            {
                rays[i].origin[k] = low[k] + size[k] * draw(&state);
            }
        } while (cm_octree_at(octree, rays[i].origin, 0, NULL) != CM_VOXEL_FREE);
        const double z = 2.0 * draw(&state) - 1.0, turn = 6.283185307179586 * draw(&state);
        rays[i].direction[0] = sqrt(1.0 - z * z) * cos(turn);
        rays[i].direction[1] = sqrt(1.0 - z * z) * sin(turn);
        rays[i].direction[2] = z;
    }
}

static void report(const char *name, const cm_octree *octree, const ray *rays, size_t runs)
{
    double *took = allocate(runs, sizeof *took);
    double sum = 0.0;
    size_t met = 0;
    for (size_t i = 0; i < runs; i++)
    {
        sum = 0.0;
        met = 0;
        const double begin = processor_seconds();
        for (size_t k = 0; k < RAYS; k++)
        {
            cm_voxel voxel;
            if (cm_octree_ray(octree, rays[k].origin, rays[k].direction, 0.0, &voxel))
            {
                sum += voxel.distance;
                met++;
            }
        }
        took[i] = (processor_seconds() - begin) / RAYS;
    }
    const timing t = summary(took, runs);
    printf("%s\t%.3f\t%.3f\t%zu met, %.9f m\n", name, 1e-6 / t.best, 1e-6 / t.median, met,
           sum / (double)met);
    free(took);
}

int main(int count, char **word)
{
    name_program("ray-speed");
    const double edge = count > 1 ? number_of(word[1]) : 0.01;
    const size_t runs = count > 2 ? (size_t)strtoul(word[2], NULL, 10) : 15;
    if (!(edge > 0.0) || runs == 0)
    {
        fprintf(stderr, "usage: ray-speed [EDGE [RUNS]]\n");
        return 2;
    }
    room_walk walk = room_walk_make(NULL, 0, 0.0);
    const cm_octree_options options = {
        .size = sizeof options, .edge = edge, .levels = 12, .color = 1};
    cm_octree *octree = room_walk_map(&walk, &options);
    ray *rays = allocate(RAYS, sizeof *rays);
    printf("%s\tbest, M rays/s\tmedian\tmet\n", system_cpu());
    static const size_t views[] = {2, 20, 40};
    for (size_t i = 0; i < sizeof views / sizeof *views; i++)
    {
        char name[32];
        snprintf(name, sizeof name, "picture %zu", views[i]);
        draw_picture(&walk, views[i], rays);
        report(name, octree, rays, runs);
    }
    draw_random(octree, rays);
    report("random", octree, rays, runs);
    free(rays);
    cm_octree_destroy(octree);
    room_walk_free(&walk);
    return close_standard_output();
}
