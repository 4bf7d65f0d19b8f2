/* SPDX-License-Identifier: MIT
 *
 * A map that is updated for long: does it grow, does it become slow? Views of the analytic room, 640 x 480 with colours, voxels of
 * 1 cm, one thread, the same walk again and again; with noise, which is another one in each view.
 *
 *   lasting-map [VIEWS [NOISE]]     10000; sigma / range, 0
 *
 * A line for each tenth of them: views so far, ms of the processor a view: least and median, MB of the map, and the most that the
 * process had so far, apart by tabs.
 */
#define _XOPEN_SOURCE 700

#include "bench/harness/harness.h"
#include "mapped_room.h"

#include <cubemap/random.h>

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

enum
{
    PARTS = 10,
    NORMALS = 1 << 20
};

/* Numbers whose beginning differs from view to view. */
static float *make_normals(void)
{
    float *normal = allocate(NORMALS, sizeof *normal);
    for (uint32_t i = 0; i < NORMALS; i++)
    {
        normal[i] = (float)cm_random_normal(1, i, 0, 0);
    }
    return normal;
}

static void add_noise(const cm_view *view, const float *normal, double noise, uint32_t index,
                      float *depth)
{
    const float *exact = view->depth.data;
    const uint32_t first = index * 2654435761u;
    for (uint32_t i = 0; i < ROOM_PIXELS; i++)
    {
        depth[i] = exact[i] * (1.0f + (float)noise * normal[(first + i) % NORMALS]);
    }
}

static double most_memory(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? 1.024e-3 * (double)usage.ru_maxrss : 0.0;
}

int main(int count, char **word)
{
    name_program("lasting-map");
    const size_t views = count > 1 ? (size_t)strtoul(word[1], NULL, 10) : 10000;
    const double noise = count > 2 ? number_of(word[2]) : 0.0;
    const size_t part = views / PARTS;
    if (part == 0 || !(noise >= 0.0 && noise < 0.2))
    {
        fprintf(stderr, "lasting-map: ten views at least, and noise below 0.2\n");
        return 2;
    }
    room_walk walk = room_walk_make(NULL, 0, 0.0);
    float *const normal = make_normals(), *const depth = allocate(ROOM_PIXELS, sizeof *depth);
    double *const took = allocate(part, sizeof *took);
    const cm_octree_options options = {
        .size = sizeof options, .edge = 0.01, .levels = 12, .color = 1, .noise = noise};
    cm_octree *octree = NULL;
    need(cm_octree_create(&options, &octree), "map");
    for (size_t i = 0; i < PARTS * part; i++)
    {
        cm_view view = walk.view[i % walk.count];
        if (noise > 0.0)
        {
            add_noise(&view, normal, noise, (uint32_t)i, depth);
            view.depth.data = depth;
        }
        const double begin = processor_seconds();
        need(cm_octree_update(octree, &view, NULL), "update");
        took[i % part] = processor_seconds() - begin;
        if ((i + 1) % part == 0)
        {
            cm_octree_count held = {.size = sizeof held};
            need(cm_octree_count_voxels(octree, &held), "count");
            const timing t = summary(took, part);
            printf("%zu\t%.2f\t%.2f\t%.2f\t%.1f\n", i + 1, 1e3 * t.best, 1e3 * t.median,
                   1e-6 * (double)held.bytes, most_memory());
            fflush(stdout);
        }
    }
    cm_octree_destroy(octree);
    free(took);
    free(depth);
    free(normal);
    room_walk_free(&walk);
    return close_standard_output();
}
