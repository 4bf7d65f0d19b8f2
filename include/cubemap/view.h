/* SPDX-License-Identifier: MIT
 *
 * Views: a depth image with its camera, pose and time. Of the library cubemap-scene.
 *
 *   depth    is along the optical axis, range along the ray; depth_is_range says which. Images of omnidirectional cameras
 *            hold range
 */
#ifndef CUBEMAP_VIEW_H
#define CUBEMAP_VIEW_H

#include <cubemap/camera.h>
#include <cubemap/image.h>
#include <cubemap/pose.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a camera saw. Pictures that are not there have data NULL. It owns nothing. */
typedef struct cm_view
{
    size_t size;             /* sizeof(cm_view) */
    double time;             /* seconds */
    const cm_camera *camera; /* of all its pictures */
    cm_pose pose;            /* world to camera */
    cm_image
        depth; /* one channel, CM_PIXEL_U16 or CM_PIXEL_FLOAT; 0 and NaN: nothing was measured */
    int depth_is_range; /* 1: along the ray; 0: along the optical axis */
    double depth_unit;  /* metres per stored unit */
    cm_image color;     /* of the depth image's size */
    cm_image amplitude; /* one channel, of the same size */
} cm_view;

#ifdef __cplusplus
}
#endif

#endif
