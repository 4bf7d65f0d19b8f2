/* SPDX-License-Identifier: MIT
 *
 * The figures of Kotfis and Cozzi, Octree Mapping from a Depth Camera (2014), of the analytic room in place of their kitchen.
 * Views have 640 x 480 pixels and colours; times are of the processor for one thread, of the clock for more.
 *
 *   octree-figures [FOLDER]     where pictures go, portable pixmaps; none without it
 *
 * Lines are words and numbers apart by tabs:
 *   depth     figure 1.7, an octree of 1.96 m: levels, edge in m, nodes of their tree, known voxels, MB, ms a view: least and
 *             median of the views that come for the first time, least and median of views that come again
 *   map       figures 1.8 and 1.6, maps of the whole room: edge in m, voxels, ms: least and median to extract them, to extract
 *             and draw them, and to trace cones
 *   level     the same of levels of the map with voxels of 1 cm: voxels are occupied if on average they are
 *   stage     figure 1.9, 5.12 m at 2 cm, all threads: threads, ms: median of an update, of extracting and drawing, of cones
 */
#include "bench/harness/harness.h"
#include "mapped_room.h"
#include "truth/room_views.h"

#include <cubemap/pool.h>
#include <cubemap/raster.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    DESK_VIEWS = 16,
    ALL_VIEWS = ROOM_VIEWS + DESK_VIEWS,
    PASSES = 3,
    RUNS = 9
};

static timing times_of(const double *took, size_t count)
{
    timing t = summary(took, count);
    t.best *= 1e3;
    t.median *= 1e3;
    return t;
}

/* ---- figure 1.7 ---- */

/* How many nodes a tree has in which eight children are together and every occupied voxel is a leaf of the last level: voxels
 * come in the order of keys, so that those of one ancestor follow each other. */
static size_t nodes_of_chapter(const cm_octree *octree)
{
    const cm_octree_options *options = cm_octree_describe(octree);
    size_t count = 0, nodes = 1;
    cm_octree_extract(octree, 0, 0, NULL, &count);
    cm_voxel *voxel = allocate(count + 1, sizeof *voxel);
    need(cm_octree_extract(octree, 0, count, voxel, &count), "extract");
    for (int level = 1; level <= options->levels; level++)
    {
        const double edge = ldexp(options->edge, level);
        double last[3] = {(double)NAN, (double)NAN, (double)NAN};
        for (size_t i = 0; i < count; i++)
        {
            const double centre[3] = {voxel[i].x, voxel[i].y, voxel[i].z};
            int is_same = 1;
            for (int k = 0; k < 3; k++)
            {
                /* the root's corner is a corner of all */
                const double at = floor((centre[k] - options->centre[k]) / edge +
                                        (level == options->levels ? 0.5 : 0.0));
                is_same = is_same && at == last[k];
                last[k] = at;
            }
            nodes += is_same ? 0 : 8;
        }
    }
    free(voxel);
    return nodes;
}

/* Around a table with a ball on it, from a step away, as somebody who turns a camera about a kitchen. */
static void desk_poses(cm_pose pose[DESK_VIEWS])
{
    for (int i = 0; i < DESK_VIEWS; i++)
    {
        const double angle = 6.28318530717958647692 * i / DESK_VIEWS;
        const double place[3] = {0.1 + 0.25 * cos(angle), 0.6 * sin(angle), 1.4 + 0.2 * cos(angle)};
        pose[i] = pose_towards(place, (const double[3]){1.8, 0.0, 0.8});
    }
}

static void report_depth(const room_walk *walk, int levels)
{
    const cm_octree_options options = {.size = sizeof options,
                                       .edge = ldexp(1.96, -levels),
                                       .levels = levels,
                                       .centre = {1.8, 0.0, 0.98},
                                       .color = 1};
    cm_octree *octree = NULL;
    double took[(PASSES + 1) * DESK_VIEWS];
    need(cm_octree_create(&options, &octree), "map");
    for (size_t i = 0; i < sizeof took / sizeof *took; i++)
    {
        const double begin = processor_seconds();
        need(cm_octree_update(octree, &walk->view[i % walk->count], NULL), "update");
        took[i] = processor_seconds() - begin;
    }
    cm_octree_count count = {.size = sizeof count};
    need(cm_octree_count_voxels(octree, &count), "count");
    const timing first = times_of(took, DESK_VIEWS);
    const timing again = times_of(took + DESK_VIEWS, PASSES * DESK_VIEWS);
    printf("depth\t%d\t%.6f\t%zu\t%llu\t%.3f\t%.3f\t%.3f\t%.3f\t%.3f\n", levels, options.edge,
           nodes_of_chapter(octree), (unsigned long long)(count.occupied + count.free),
           1e-6 * (double)count.bytes, first.best, first.median, again.best, again.median);
    cm_octree_destroy(octree);
}

/* ---- figures 1.8 and 1.6 ---- */

/* Voxels as discs that turn to the camera, an array for each number, to draw as instances are drawn. */
typedef struct instances
{
    size_t room;
    size_t count;
    cm_voxel *voxel;
    float *number; /* 7 x room */
    cm_raster *raster;
    uint32_t *id;
} instances;

static instances make_instances(const cm_octree *octree, const cm_camera *camera)
{
    instances all = {0};
    cm_octree_extract(octree, 0, 0, NULL, &all.room);
    all.room += all.room / 2 + 1; /* maps that grow */
    all.voxel = allocate(all.room, sizeof *all.voxel);
    all.number = allocate(7 * all.room, sizeof *all.number);
    all.id = allocate(ROOM_PIXELS, sizeof *all.id);
    need(cm_raster_create(camera, 0.0, NULL, &all.raster), "canvas");
    return all;
}

static void free_instances(instances *all)
{
    free(all->voxel);
    free(all->number);
    free(all->id);
    cm_raster_destroy(all->raster);
}

/* A disc has the area that a cube shows on average: its surface over four, by Cauchy. */
static void draw_instances(instances *all, const cm_pose *pose, unsigned threads, cm_image *color)
{
    const double radius = sqrt(1.5 / 3.14159265358979323846);
    float *number[7];
    for (size_t k = 0; k < 7; k++)
    {
        number[k] = all->number + k * all->room;
    }
    for (size_t i = 0; i < all->count; i++)
    {
        const cm_voxel *voxel = &all->voxel[i];
        const double centre[3] = {voxel->x, voxel->y, voxel->z};
        for (int k = 0; k < 3; k++)
        {
            number[k][i] = (float)centre[k];
            number[3 + k][i] = (float)(pose->position[k] - centre[k]);
        }
        number[6][i] = (float)(radius * voxel->edge);
    }
    const cm_discs discs = {.size = sizeof discs,
                            .count = all->count,
                            .centre = {number[0], number[1], number[2]},
                            .normal = {number[3], number[4], number[5]},
                            .radius = number[6]};
    cm_raster_clear(all->raster);
    need(cm_raster_discs(all->raster, pose, &discs, threads), "discs");
    need(cm_raster_read(all->raster, NULL, all->id), "canvas");
    uint8_t *pixel = color->data;
    for (size_t i = 0; i < ROOM_PIXELS; i++)
    {
        const uint32_t id = all->id[i];
        memcpy(pixel + 3 * i, id == CM_RASTER_NOTHING ? (uint8_t[3]){0} : all->voxel[id].color, 3);
    }
}

static cm_image picture_of(uint8_t *pixel)
{
    return (cm_image){.size = sizeof(cm_image),
                      .data = pixel,
                      .type = CM_PIXEL_U8,
                      .width = ROOM_WIDTH,
                      .height = ROOM_HEIGHT,
                      .channels = 3};
}

static void write_named(const char *folder, const char *name, double edge, const cm_image *image)
{
    char path[1000];
    if (folder != NULL && snprintf(path, sizeof path, "%s/octree-%s-%.0fcm.ppm", folder, name,
                                   100.0 * edge) < (int)sizeof path)
    {
        write_pixmap(path, image);
    }
}

static void report_level(const char *word, const cm_octree *octree, const room_walk *walk,
                         const cm_pose *pose, int level, const char *folder)
{
    static uint8_t pixel[ROOM_PIXELS][3];
    const double edge = ldexp(cm_octree_describe(octree)->edge, level);
    instances all = make_instances(octree, walk->camera);
    cm_image color = picture_of(pixel[0]);
    double extracted[RUNS], drawn[RUNS], traced[RUNS];
    for (int i = 0; i < RUNS; i++)
    {
        const double begin = processor_seconds();
        need(cm_octree_extract(octree, level, all.room, all.voxel, &all.count), "extract");
        extracted[i] = processor_seconds() - begin;
        draw_instances(&all, pose, 1, &color);
        drawn[i] = processor_seconds() - begin;
    }
    write_named(folder, level > 0 ? "averages" : "instances", edge, &color);
    const cm_octree_shading shading = {.size = sizeof shading, .coarsest = level};
    for (int i = 0; i < RUNS; i++)
    {
        const double begin = processor_seconds();
        need(cm_octree_render(octree, walk->camera, pose, &shading, &color, NULL), "cones");
        traced[i] = processor_seconds() - begin;
    }
    write_named(folder, level > 0 ? "capped" : "cones", edge, &color);
    const timing of_extraction = times_of(extracted, RUNS), of_drawing = times_of(drawn, RUNS),
                 of_cones = times_of(traced, RUNS);
    printf("%s\t%.2f\t%zu\t%.2f\t%.2f\t%.2f\t%.2f\t%.2f\t%.2f\n", word, edge, all.count,
           of_extraction.best, of_extraction.median, of_drawing.best, of_drawing.median,
           of_cones.best, of_cones.median);
    free_instances(&all);
}

/* Maps of other edges, and then levels of the finest. */
static void report_levels(const room_walk *walk, const cm_pose *pose, const char *folder)
{
    for (int level = 4; level >= 0; level--)
    {
        const cm_octree_options options = {
            .size = sizeof options, .edge = ldexp(0.01, level), .levels = 10 - level, .color = 1};
        cm_octree *octree = room_walk_map(walk, &options);
        report_level("map", octree, walk, pose, 0, folder);
        for (int above = 4; level == 0 && above > 0; above--)
        {
            report_level("level", octree, walk, pose, above, folder);
        }
        cm_octree_destroy(octree);
    }
}

/* ---- figure 1.9 ---- */

/* A camera's round: the view goes into the map, and the map is drawn from there, in both ways. */
static void report_stages(const room_walk *walk)
{
    static uint8_t pixel[ROOM_PIXELS][3];
    cm_image color = picture_of(pixel[0]);
    const cm_octree_options options = {
        .size = sizeof options, .edge = 0.02, .levels = 8, .centre = {0, 0, 1.28}, .color = 1};
    cm_pool *pool = NULL;
    double updated[ALL_VIEWS], drawn[ALL_VIEWS], traced[ALL_VIEWS];
    need(cm_pool_create(0, &pool), "threads");
    cm_octree *octree = room_walk_map(walk, &options);
    instances all = make_instances(octree, walk->camera);
    need(cm_raster_use_pool(all.raster, pool), "threads");
    const cm_octree_shading shading = {.size = sizeof shading, .pool = pool};
    for (size_t i = 0; i < ALL_VIEWS; i++)
    {
        const cm_view *view = &walk->view[i];
        const double begin = seconds();
        need(cm_octree_update(octree, view, pool), "update");
        const double mapped = seconds();
        need(cm_octree_extract(octree, 0, all.room, all.voxel, &all.count), "extract");
        draw_instances(&all, &view->pose, 0, &color);
        const double seen = seconds();
        need(cm_octree_render(octree, walk->camera, &view->pose, &shading, &color, NULL), "cones");
        traced[i] = seconds() - seen;
        drawn[i] = seen - mapped;
        updated[i] = mapped - begin;
    }
    printf("stage\t%u\t%.2f\t%.2f\t%.2f\n", cm_pool_threads(pool),
           times_of(updated, ALL_VIEWS).median, times_of(drawn, ALL_VIEWS).median,
           times_of(traced, ALL_VIEWS).median);
    free_instances(&all);
    cm_octree_destroy(octree);
    cm_pool_destroy(pool);
}

int main(int count, char **word)
{
    name_program("octree-figures");
    const char *folder = count > 1 ? word[1] : NULL;
    cm_pose pose[ALL_VIEWS];
    desk_poses(pose);
    room_walk walk = room_walk_make(pose, DESK_VIEWS, 0.0);
    for (int levels = 4; levels <= 10; levels++)
    {
        report_depth(&walk, levels);
    }
    room_walk_free(&walk);
    for (size_t i = 0; i < ROOM_VIEWS; i++)
    {
        pose[DESK_VIEWS + i] = room_pose(i, ROOM_VIEWS);
    }
    walk = room_walk_make(pose, ALL_VIEWS, 0.0);
    report_levels(&walk, &pose[2], folder);
    report_stages(&walk);
    room_walk_free(&walk);
    return close_standard_output();
}
