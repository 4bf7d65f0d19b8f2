/* SPDX-License-Identifier: MIT
 *
 * What pictures of a map of the analytic room cost, by one thread: perspective ones of 640 x 480 pixels, without and with light,
 * at levels 0 to 4, and a light probe of six faces of 128 x 128. Best and median of many runs, ms of the processor.
 *
 *   see-speed [EDGE [PICTURES]]     PICTURES: the beginning of names of files, portable pixmaps
 */
#include "bench/harness/harness.h"
#include "mapped_room.h"

#include <stdio.h>

enum
{
    FACE = 128,
    RUNS = 15
};

static uint8_t pixel[ROOM_PIXELS][3];
static float depth[ROOM_PIXELS];

static void report(const char *name, const cm_octree *octree, const cm_camera *camera,
                   const cm_pose *pose, const cm_octree_shading *shading, const char *pictures)
{
    const cm_camera_options *lens = cm_camera_describe(camera);
    double took[RUNS];
    cm_image color = {.size = sizeof color,
                      .data = pixel,
                      .type = CM_PIXEL_U8,
                      .width = lens->width,
                      .height = lens->height,
                      .channels = 3};
    cm_image range = color;
    range.data = depth;
    range.type = CM_PIXEL_FLOAT;
    range.channels = 1;
    for (int i = 0; i < RUNS; i++)
    {
        const double begin = processor_seconds();
        need(cm_octree_render(octree, camera, pose, shading, &color, &range), "cones");
        took[i] = processor_seconds() - begin;
    }
    const timing t = summary(took, RUNS);
    printf("  %-16s %7.1f  %7.1f\n", name, 1e3 * t.best, 1e3 * t.median);
    if (pictures != NULL)
    {
        char path[256];
        snprintf(path, sizeof path, "%s%s.ppm", pictures, name);
        write_pixmap(path, &color);
    }
}

int main(int count, char **word)
{
    name_program("see-speed");
    const double edge = count > 1 ? number_of(word[1]) : 0.01;
    const char *pictures = count > 2 ? word[2] : NULL;
    cm_camera *probe = NULL;
    cm_mapping *mapping = NULL;
    need(cm_mapping_create("coupled", NULL, &mapping), "mapping");
    const cm_camera_options faces = {.size = sizeof faces,
                                     .width = FACE,
                                     .height = 6 * FACE,
                                     .pixel_centre = 0.5,
                                     .mapping = mapping};
    need(cm_camera_create(&faces, &probe), "camera");
    room_walk walk = room_walk_make(NULL, 0, 0.0);
    const cm_octree_options options = {
        .size = sizeof options, .edge = edge, .levels = 12, .color = 1};
    cm_octree *octree = room_walk_map(&walk, &options);
    const cm_camera *camera = walk.camera;
    const cm_pose pose = walk.view[2].pose;
    printf("%s\n  ms: best, median\n", system_cpu());
    cm_octree_shading shading = {.size = sizeof shading};
    report("level0", octree, camera, &pose, &shading, pictures);
    static const char *const levels[] = {"level0", "level1", "level2", "level3", "level4"};
    for (shading.coarsest = 1; shading.coarsest <= 4; shading.coarsest++)
    {
        report(levels[shading.coarsest], octree, camera, &pose, &shading, pictures);
    }
    shading =
        (cm_octree_shading){.size = sizeof shading, .light = 1, .light_position = {0.5, -1.0, 2.4}};
    report("light", octree, camera, &pose, &shading, pictures);
    report("probe", octree, probe, &pose, NULL, pictures);
    cm_octree_destroy(octree);
    room_walk_free(&walk);
    cm_camera_destroy(probe);
    cm_mapping_destroy(mapping);
    return close_standard_output();
}
