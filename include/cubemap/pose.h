/* SPDX-License-Identifier: MIT
 *
 * Poses: where a camera is and how it stands, as rotation and place. Of the library cubemap-scene.
 *
 *   axes      x_camera = rotation (x_world - position): the rotation's rows are the camera's axes in the world
 *   units     as the user's, metres by custom; angles in radians
 *   bad input NaN gives NaN; nothing traps
 */
#ifndef CUBEMAP_POSE_H
#define CUBEMAP_POSE_H

#include <cubemap/export.h>
#include <cubemap/orientation.h>
#include <cubemap/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A camera in the world. This struct will not change. */
typedef struct cm_pose
{
    cm_rotation rotation; /* rows: the camera's axes in the world */
    double position[3];   /* the camera's centre in the world */
} cm_pose;

/* World to camera, and back. to may be from. */
CM_API void cm_pose_apply(const cm_pose *pose, const double world[3], double camera[3]);
CM_API void cm_pose_apply_back(const cm_pose *pose, const double camera[3], double world[3]);

#ifdef __cplusplus
}
#endif

#endif
