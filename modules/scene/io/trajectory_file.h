/* SPDX-License-Identifier: MIT
 *
 * Texts of trajectories: lines of TUM, "time tx ty tz qx qy qz qw", and trajectory.log of ICL and Open3D, a line of three
 * numbers and a matrix of 4 x 4, both from camera to world.
 *
 *   lines       what is empty or begins with # says nothing; numbers stand apart by blanks, tabs or commas
 *   refused     NaN and infinity; times that are not after the one before; quaternions more than 1e-3 off unit length, and
 *               matrices whose rows are more than 1e-3 off orthonormal (nearer ones are brought there); more or fewer numbers
 *   message     one line of CM_IMAGE_MESSAGE bytes at most, "FILE:LINE: what is wrong". Written on failure only
 *   failures    CM_ERROR_ARGUMENT, CM_ERROR_MEMORY, CM_ERROR_FILE, CM_ERROR_DATA
 */
#ifndef CUBEMAP_MODULES_SCENE_TRAJECTORY_FILE_H
#define CUBEMAP_MODULES_SCENE_TRAJECTORY_FILE_H

#include <cubemap/pose.h>

#include "modules/image/io/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Times in seconds and poses, count of each. */
typedef struct cm_pose_list
{
    size_t count;
    double *time; /* of trajectory.log NULL */
    cm_pose *pose;
} cm_pose_list;

/* Give back what the functions below have made, and make it empty. */
void cm_pose_list_clear(cm_pose_list *list);

/* A file of lines as TUM's. A file without any is CM_ERROR_DATA. */
cm_status cm_trajectory_file_read(const char *path, cm_pose_list *list, char *message);
/* The same of a text; name is for the message. */
cm_status cm_trajectory_file_parse(const char *name, const char *text, size_t length,
                                   cm_pose_list *list, char *message);

/* trajectory.log: entry N of the list is pose N, whatever its line of three numbers says. */
cm_status cm_trajectory_log_read(const char *path, cm_pose_list *list, char *message);
cm_status cm_trajectory_log_parse(const char *name, const char *text, size_t length,
                                  cm_pose_list *list, char *message);

/* Sixteen numbers in four lines, as frame-NNNNNN.pose.txt of 7-Scenes: one pose. */
cm_status cm_pose_file_parse(const char *name, const char *text, size_t length, cm_pose *pose,
                             char *message);

/* Write lines of TUM, which appear when they are complete. Times have six digits behind the point, or more if that is not
 * the same number; the other numbers are the same to the bit when they are read, but for the rotation's rounding. */
cm_status cm_trajectory_file_write(const char *path, size_t count, const double *time,
                                   const cm_pose *pose, char *message);

/* Write trajectory.log. */
cm_status cm_trajectory_log_write(const char *path, size_t count, const cm_pose *pose,
                                  char *message);

#ifdef __cplusplus
}
#endif

#endif
