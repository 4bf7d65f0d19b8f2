/* SPDX-License-Identifier: MIT
 *
 * Updates by cameras with distortion or a mapping.
 */
#ifndef MODULES_OCTREE_UPDATE_ROUND_H
#define MODULES_OCTREE_UPDATE_ROUND_H

#include "pixel_tree.h"
#include "update_desk.h"

/* What is known of a camera, and what the pixels of its last view say; kept as rounds of cm_update_desk. */
typedef struct cm_round_desk
{
    cm_camera_options camera; /* whose cones these are */
    cm_pixel_tree tree;
    cm_rays *rays;
    float *memory; /* eight images */
    float *vertex[3], *normal[3];
    float *front, *five;
    cm_pixel_rule *rule;
    int is_range;
    int around; /* least fronts are over so many windows of 5 x 5, one after the other */
} cm_round_desk;

/* As the update of a straight camera, after cm_view_desk_clean. */
cm_status cm_update_round(cm_update *update, cm_pool *pool);

#endif
