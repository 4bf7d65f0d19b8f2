/* SPDX-License-Identifier: MIT */
#include "mapped_room.h"

#include "bench/harness/harness.h"
#include "truth/room_views.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void need(cm_status status, const char *what)
{
    if (status != CM_OK)
    {
        fprintf(stderr, "%s: %s: %s\n", program_name(), what, cm_status_text(status));
        exit(1);
    }
}

cm_camera *room_camera(void)
{
    const cm_camera_options lens = {.size = sizeof lens,
                                    .width = ROOM_WIDTH,
                                    .height = ROOM_HEIGHT,
                                    .fx = 525,
                                    .fy = 525,
                                    .cx = 319.5,
                                    .cy = 239.5};
    cm_camera *camera = NULL;
    need(cm_camera_create(&lens, &camera), "camera");
    return camera;
}

cm_pose pose_towards(const double place[3], const double at[3])
{
    cm_pose pose = {.position = {place[0], place[1], place[2]}};
    double(*const axis)[3] = pose.rotation.row;
    const double to[3] = {at[0] - place[0], at[1] - place[1], at[2] - place[2]};
    const double level = hypot(to[0], to[1]), length = hypot(level, to[2]);
    for (int k = 0; k < 3; k++)
    {
        axis[2][k] = to[k] / length;
    }
    axis[0][0] = to[1] / level;
    axis[0][1] = -to[0] / level;
    axis[0][2] = 0.0;
    for (int k = 0; k < 3; k++)
    {
        axis[1][k] = axis[2][(k + 1) % 3] * axis[0][(k + 2) % 3] -
                     axis[2][(k + 2) % 3] * axis[0][(k + 1) % 3];
    }
    return pose;
}

/* A view whose pictures are copies of what the scene shows. */
static void keep_view(room_walk *walk, size_t index, const cm_pose *pose,
                      const room_picture *picture)
{
    float *depth = walk->depth + index * ROOM_PIXELS;
    uint8_t *color = walk->color + index * ROOM_PIXELS * 3;
    memcpy(depth, picture->measured, ROOM_PIXELS * sizeof *depth);
    memcpy(color, picture->color, (size_t)ROOM_PIXELS * 3);
    walk->view[index] = room_picture_view(picture, walk->camera, pose, 1);
    walk->view[index].depth.data = depth;
    walk->view[index].color.data = color;
}

room_walk room_walk_make(const cm_pose *pose, size_t count, double noise)
{
    room_walk walk = {.camera = room_camera(), .count = pose != NULL ? count : ROOM_VIEWS};
    walk.view = allocate(walk.count, sizeof *walk.view);
    walk.depth = allocate(walk.count * ROOM_PIXELS, sizeof *walk.depth);
    walk.color = allocate(walk.count * ROOM_PIXELS, 3);
    cm_scene *scene = NULL;
    room_picture picture;
    need(cm_scene_create_named("room", &scene), "room");
    need(room_picture_make(walk.camera, &picture) ? CM_OK : CM_ERROR_MEMORY, "pictures");
    for (size_t i = 0; i < walk.count; i++)
    {
        const cm_pose from = pose != NULL ? pose[i] : room_pose(i, walk.count);
        room_picture_take(scene, walk.camera, &from, noise, (uint32_t)i, &picture);
        keep_view(&walk, i, &from, &picture);
    }
    room_picture_free(&picture);
    cm_scene_destroy(scene);
    return walk;
}

void room_walk_free(room_walk *walk)
{
    free(walk->view);
    free(walk->depth);
    free(walk->color);
    cm_camera_destroy(walk->camera);
    *walk = (room_walk){0};
}

cm_octree *room_walk_map(const room_walk *walk, const cm_octree_options *options)
{
    cm_octree *octree = NULL;
    need(cm_octree_create(options, &octree), "map");
    for (size_t i = 0; i < walk->count; i++)
    {
        need(cm_octree_update(octree, &walk->view[i], NULL), "update");
    }
    return octree;
}

void write_pixmap(const char *path, const cm_image *image)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL)
    {
        need(CM_ERROR_FILE, path);
        return;
    }
    const size_t bytes = (size_t)3 * image->width * image->height;
    fprintf(file, "P6\n%u %u\n255\n", image->width, image->height);
    const int failed = fwrite(image->data, 1, bytes, file) != bytes;
    need(fclose(file) != 0 || failed ? CM_ERROR_FILE : CM_OK, path);
}
