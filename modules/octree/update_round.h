/* SPDX-License-Identifier: MIT
 *
 * Updates by cameras with distortion or a mapping.
 */
#ifndef MODULES_OCTREE_UPDATE_ROUND_H
#define MODULES_OCTREE_UPDATE_ROUND_H

#include <math.h>
#include <string.h>

#include "pixel_tree.h"
#include "round_faces.h"
#include "update_desk.h"

/* What is known of a camera, and what the pixels of its last view say; kept as rounds of cm_update_desk. */
typedef struct cm_round_desk
{
    cm_camera_options camera; /* whose cones these are */
    cm_pixel_tree tree;
    cm_round_faces faces;
    cm_rays *rays; /* of a lens, once a view had range; else NULL */
    float *
        memory; /* of what follows; CM_PIXEL_SLACK floats before and behind each image can be read */
    float *ray[3];  /* of pixels, at range or depth 1; of surroundings the tree's */
    float *inverse; /* 1 / value */
    float *none;    /* a row of NaN */
    float *reach, *front, *five, *bound[2];
    cm_pixel_rule *rule;
    int is_range;
    int around; /* least fronts are over so many windows of 5 x 5, one after the other */
} cm_round_desk;

/* An update at work. */
typedef struct cm_round_work
{
    cm_update *update;
    cm_round_desk *round;
} cm_round_work;

/* How far from its depth a pixel hits; negative: it hits nothing. */
static inline float cm_round_reach(const cm_pixel_rule *rule)
{
    const uint32_t lower = rule->reach_front << 16;
    float reach;
    memcpy(&reach, &lower, sizeof reach);
    return reach;
}

/* Of a point in the camera's axes what pixels measure: range of omnidirectional cameras, depth of lenses. */
static inline double cm_round_value(const cm_round_desk *round, const double at[3])
{
    return round->is_range ? sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]) : at[2];
}

/* The picture of a view, as loops ask it. */
static inline cm_round_picture cm_round_picture_of(const cm_update *update,
                                                   const cm_round_desk *round)
{
    return (cm_round_picture){.width = round->tree.width,
                              .height = round->tree.height,
                              .stride = (uint32_t)update->desk->view.stride,
                              .pixel_centre = round->camera.pixel_centre,
                              .rule = round->rule};
}

/* Pixels of the whole picture are as wide as these in the mean, at distance 1. */
double cm_round_mean_pixel(const cm_camera_options *camera);

/* The rules of all pixels of a cleaned view, and their bounds into the tree of cones. */
cm_status cm_round_rules_make(const cm_update *update, cm_round_desk *round, cm_pool *pool);

/* As cm_ray_ends_find, after the rules of a view are there. */
cm_status cm_round_ends_find(const cm_update *update, const cm_round_desk *round, cm_pool *pool,
                             cm_ray_ends *ends);

/* The class of a cube of 2^level voxels at a place, whatever its size: by cones. */
unsigned cm_round_class_of(const cm_round_work *work, const uint32_t place[3], int level);

/* Update a region. */
void cm_round_region(const cm_round_work *work, cm_region *region);

/* As the update of a straight camera, after cm_view_desk_clean. */
cm_status cm_update_round(cm_update *update, cm_pool *pool);

#endif
