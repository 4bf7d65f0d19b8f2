/* SPDX-License-Identifier: MIT
 *
 * What the programs of this folder share: an end when something fails, the camera, views of the analytic room kept in memory so
 * that making them is not measured, and pictures as files.
 */
#ifndef BENCH_OCTREE_MAPPED_ROOM_H
#define BENCH_OCTREE_MAPPED_ROOM_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/camera.h>
#include <cubemap/octree.h>
#include <cubemap/view.h>

enum
{
    ROOM_WIDTH = 640,
    ROOM_HEIGHT = 480,
    ROOM_PIXELS = ROOM_WIDTH * ROOM_HEIGHT,
    ROOM_VIEWS = 60
};

/* The end of the program, after a message, for any other status. */
void need(cm_status status, const char *what);

/* 640 x 480 pixels, 525 of them the focal length, as Kinect's are said to be. */
cm_camera *room_camera(void);

/* The pose of a camera at a place that looks at another, its columns level. */
cm_pose pose_towards(const double place[3], const double at[3]);

/* Views that keep their pictures. */
typedef struct room_walk
{
    cm_camera *camera;
    size_t count;
    cm_view *view;
    float *depth;   /* count x ROOM_PIXELS */
    uint8_t *color; /* count x ROOM_PIXELS x 3 */
} room_walk;

/* From these poses; NULL: ROOM_VIEWS of room_pose. noise is sigma / range. To be given to room_walk_free. */
room_walk room_walk_make(const cm_pose *pose, size_t count, double noise);
void room_walk_free(room_walk *walk);

/* All views into a map that must be made. */
cm_octree *room_walk_map(const room_walk *walk, const cm_octree_options *options);

/* A portable pixmap of three bytes a pixel. */
void write_pixmap(const char *path, const cm_image *image);

#endif
