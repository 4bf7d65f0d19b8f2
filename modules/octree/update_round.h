/* SPDX-License-Identifier: MIT
 *
 * Updates by cameras with distortion or a mapping.
 */
#ifndef MODULES_OCTREE_UPDATE_ROUND_H
#define MODULES_OCTREE_UPDATE_ROUND_H

#include <math.h>
#include <string.h>

#include "pixel_tree.h"
#include "update_desk.h"

/* What is known of a camera, and what the pixels of its last view say; kept as rounds of cm_update_desk. */
typedef struct cm_round_desk
{
    cm_camera_options camera; /* whose cones these are */
    cm_pixel_tree tree;
    cm_rays *rays;  /* of a lens, once a view had range; else NULL */
    float *memory;  /* of what follows */
    float *ray[3];  /* of pixels, at range or depth 1; of surroundings the tree's */
    float *inverse; /* 1 / value */
    float *reach, *front, *five, *bound[2];
    cm_pixel_rule *rule;
    int is_range;
    int around; /* least fronts are over so many windows of 5 x 5, one after the other */
} cm_round_desk;

/* How far from its depth a pixel hits; negative: it hits nothing. */
static inline float cm_round_reach(const cm_pixel_rule *rule)
{
    const uint32_t lower = rule->reach_front << 16;
    float reach;
    memcpy(&reach, &lower, sizeof reach);
    return reach;
}

/* What a pixel says of a value: 1 a hit, -1 a miss, 0 nothing. Cells are `scale` voxels wide. */
static inline int cm_round_word(const cm_pixel_rule *rule, float value, float scale)
{
    const uint32_t upper = rule->reach_front & 0xffff0000u;
    const float reach = cm_round_reach(rule);
    float front;
    memcpy(&front, &upper, sizeof front);
    const float away = value - rule->depth;
    front += (reach > 0.0f ? reach : 0.0f) * (scale - 1.0f);
    return fabsf(away) <= reach * scale ? 1 : away + front < 0.0f ? -1 : 0;
}

/* Of a point in the camera's axes what pixels measure: range of omnidirectional cameras, depth of lenses. */
static inline double cm_round_value(const cm_round_desk *round, const double at[3])
{
    return round->is_range ? sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]) : at[2];
}

/* The pixel that a place in the picture falls on, NaN for none, from 0 on; SIZE_MAX: none. */
static inline size_t cm_round_pixel(const cm_round_desk *round, double column, double row)
{
    const double c = column - round->camera.pixel_centre + 0.5;
    const double r = row - round->camera.pixel_centre + 0.5;
    const int is_inside = c >= 0.0 && c < round->tree.width && r >= 0.0 && r < round->tree.height;
    return is_inside ? (size_t)r * round->tree.width + (size_t)c : SIZE_MAX;
}

/* Pixels of the whole picture are as wide as these in the mean, at distance 1. */
double cm_round_mean_pixel(const cm_camera_options *camera);

/* The rules of all pixels of a cleaned view, and their bounds into the tree of cones. */
cm_status cm_round_rules_make(const cm_update *update, cm_round_desk *round, cm_pool *pool);

/* As cm_ray_ends_find, after the rules of a view are there. */
cm_status cm_round_ends_find(const cm_update *update, const cm_round_desk *round, cm_pool *pool,
                             cm_ray_ends *ends);

/* As the update of a straight camera, after cm_view_desk_clean. */
cm_status cm_update_round(cm_update *update, cm_pool *pool);

#endif
