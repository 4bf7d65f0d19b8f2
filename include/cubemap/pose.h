/* SPDX-License-Identifier: MIT
 *
 * Poses: where a camera is and how it stands, as rotation and place. Of the library cubemap-scene.
 *
 *   axes      x_camera = rotation (x_world - position): the rotation's rows are the camera's axes in the world
 *   motion    a pose stands for the rigid motion from camera to world, as a line of TUM does: products, twists and adjoints
 *             are those of x_world = rotation^T x_camera + position
 *   twist     six numbers, translation first: v, then the rotation vector w in radians; exp is of the matrix with the
 *             cross product by w and the column v
 *   units     as the user's, metres by custom; angles in radians
 *   bad input NaN gives NaN; nothing traps. Where the header says nothing else, pointers are not NULL, and what is written
 *             may be what is read
 *   threads   any number may call
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

/* Is it finite, and its rotation orthonormal as cm_rotation_check asks? CM_OK; CM_ERROR_ARGUMENT (NULL);
 * CM_ERROR_CAMERA. */
CM_API cm_status cm_pose_check(const cm_pose *pose);

/* World to camera, and back. to may be from. */
CM_API void cm_pose_apply(const cm_pose *pose, const double world[3], double camera[3]);
CM_API void cm_pose_apply_back(const cm_pose *pose, const double camera[3], double world[3]);

/* The product outer inner: inner is a pose in the axes of the camera outer, and so in outer's world. */
CM_API void cm_pose_compose(const cm_pose *outer, const cm_pose *inner, cm_pose *product);

/* The world's pose in the camera's axes. */
CM_API void cm_pose_invert(const cm_pose *pose, cm_pose *inverse);

/* The pose of to in the axes of from, from^-1 to: the motion from one view to another. Places far from the origin lose
 * nothing that their difference has. */
CM_API void cm_pose_between(const cm_pose *from, const cm_pose *to, cm_pose *between);

/* The motion of a twist, and the twist of a motion, whose angle is in [0, pi]. At pi, where both senses of the axis are
 * right, it is that of the quaternion of cm_pose_quaternion. exp takes any angle, and log any orthonormal rotation. */
CM_API void cm_pose_exp(const double twist[6], cm_pose *pose);
CM_API void cm_pose_log(const cm_pose *pose, double twist[6]);

/* The angle of the rotation, in [0, pi]. */
CM_API double cm_pose_angle(const cm_pose *pose);

/* Along the screw that leads from one pose to the other: from exp(t log(from^-1 to)); at t = 0 and t = 1 these poses
 * themselves, and beyond them on the same screw. */
CM_API void cm_pose_interpolate(const cm_pose *from, const cm_pose *to, double t, cm_pose *pose);

/* The matrix, by rows, for which pose exp(twist) = exp(adjoint twist) pose: a small twist in the camera's axes as one in
 * the world's. */
CM_API void cm_pose_adjoint(const cm_pose *pose, double adjoint[36]);

/* The covariance, by rows, of small twists in the camera's axes as that of twists in the world's: adjoint covariance
 * adjoint^T. The result is symmetric if covariance is. For the other way give the inverse pose. */
CM_API void cm_pose_transport(const cm_pose *pose, const double covariance[36],
                              double transported[36]);

/* The rotation from camera to world as a unit quaternion x y z w, as a line of TUM has it. w is not less than 0, and
 * where it is 0 the first of x, y, z that is not is greater than 0. */
CM_API void cm_pose_quaternion(const cm_pose *pose, double quaternion[4]);

/* A pose from its position and that quaternion, which is normalised if its length is within 1e-3 of 1.
 * CM_OK; CM_ERROR_ARGUMENT (NULL); CM_ERROR_CAMERA (another length, or numbers that are not finite). */
CM_API cm_status cm_pose_from_quaternion(const double position[3], const double quaternion[4],
                                         cm_pose *pose);

#ifdef __cplusplus
}
#endif

#endif
