/* SPDX-License-Identifier: MIT
 *
 * Views of an analytic world from a walk in its middle, and what a map made of them should have: which voxels of a grid the
 * surfaces cross, which of them the views saw, and how far a point is from the nearest surface. Nothing of the octree is used.
 *
 *   grid     voxel k is [k, k + 1) edges from the centre along each axis
 *   crossed  a surface has points inside of the voxel, not on its border alone
 *   visible  a ray through a pixel's centre meets a surface inside of the voxel; where the surface is the border of two voxels,
 *            the one in front of it stands for both
 */
#ifndef TRUTH_ROOM_VIEWS_H
#define TRUTH_ROOM_VIEWS_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/camera.h>
#include <cubemap/pose.h>
#include <cubemap/view.h>
#include <cubemap/world.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The pose of one of many views on a circle of 0.7 m, 1 to 1.6 m above the floor, which look outwards and up and down. */
cm_pose room_pose(size_t index, size_t count);

/* Everything that is seen, by pixels, row by row. To be given to room_picture_free. */
typedef struct room_picture
{
    size_t pixels;
    double *
        depth; /* along the optical axis, or range of omnidirectional cameras; infinite where nothing is met */
    double *point[3];     /* what is met */
    double *normal[3];    /* towards the camera */
    double *cosine;       /* of the angle between ray and normal */
    float *measured;      /* the depth with noise; 0 where nothing is met */
    unsigned char *color; /* three bytes a pixel */
} room_picture;

/* 1, or 0 without memory. */
int room_picture_make(const cm_camera *camera, room_picture *picture);
void room_picture_free(room_picture *picture);

/* Cast a ray for each pixel. noise is sigma / range, drawn for the view's index. */
void room_picture_take(const cm_scene *scene, const cm_camera *camera, const cm_pose *pose,
                       double noise, uint32_t index, room_picture *picture);

/* It as a view; it lives as long as camera and picture. */
cm_view room_picture_view(const room_picture *picture, const cm_camera *camera, const cm_pose *pose,
                          int color);

/* What is asked about a map. */
typedef struct room_truth
{
    const cm_scene *scene;
    double edge;
    double centre[3];
    double least[3]; /* of the world that is judged */
    double greatest[3];
    int64_t first[3]; /* voxels from here on, */
    size_t count[3];  /* so many */
    unsigned char *
        seen; /* a voxel each: 5 bits for the best cosine and 3 for which neighbour it shares the surface with */
} room_truth;

/* Of the world between two corners. 1, or 0 without memory. */
int room_truth_make(const cm_scene *scene, double edge, const double centre[3],
                    const double least[3], const double greatest[3], room_truth *truth);
void room_truth_free(room_truth *truth);

/* What a picture saw is visible from now on. */
void room_truth_see(room_truth *truth, const room_picture *picture);

/* How far a point is from the nearest surface. */
double room_truth_distance(const room_truth *truth, const double point[3]);

/* Has a surface points inside of the voxel that has this point? */
int room_truth_crossed(const room_truth *truth, const double point[3]);

/* The map that is judged: 0 unknown, 1 free, 2 occupied at a point. */
typedef int (*room_state)(const void *map, const double point[3]);

typedef struct room_errors
{
    uint64_t visible;
    uint64_t visible_occupied;
    uint64_t visible_free;
    uint64_t grazing; /* of the visible those that no ray met steeper than 0.2, as a cosine */
    uint64_t grazing_occupied;
    uint64_t crossed;
    uint64_t crossed_free;
    uint64_t occupied; /* of the map, as room_truth_judge_occupied was told */
    uint64_t off;      /* of those: further than 1.5 edges from a surface */
} room_errors;

/* Counts visible and crossed voxels. */
void room_truth_judge(const room_truth *truth, const void *map, room_state state,
                      room_errors *errors);

/* Counts one occupied voxel with this centre. */
void room_truth_judge_occupied(const room_truth *truth, const double centre[3],
                               room_errors *errors);

#ifdef __cplusplus
}
#endif

#endif
