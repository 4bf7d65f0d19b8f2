/* SPDX-License-Identifier: MIT
 *
 * Trajectories: their poses, the nearest one, and those between.
 */
#include <cubemap/trajectory.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "trajectory_data.h"

/* The first index that is wrong, or n; and why. */
static size_t find_wrong(size_t n, const double *stamp, const cm_pose *pose, cm_status *why)
{
    for (size_t i = 0; i < n; i++)
    {
        if (!isfinite(stamp[i]) || (i > 0 && stamp[i] <= stamp[i - 1]))
        {
            *why = CM_ERROR_DATA;
            return i;
        }
        if (cm_pose_check(&pose[i]) != CM_OK)
        {
            *why = CM_ERROR_CAMERA;
            return i;
        }
    }
    return n;
}

cm_status cm_trajectory_create(size_t n, const double *stamp, const cm_pose *pose,
                               cm_trajectory **trajectory, size_t *wrong)
{
    if (n == 0 || stamp == NULL || pose == NULL || trajectory == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    cm_status why = CM_OK;
    const size_t at = find_wrong(n, stamp, pose, &why);
    if (at < n)
    {
        if (wrong != NULL)
        {
            *wrong = at;
        }
        return why;
    }
    cm_trajectory *made = malloc(sizeof *made);
    double *stamps = calloc(n, sizeof *stamps);
    cm_pose *poses = calloc(n, sizeof *poses);
    if (made == NULL || stamps == NULL || poses == NULL)
    {
        free(made);
        free(stamps);
        free(poses);
        return CM_ERROR_MEMORY;
    }
    memcpy(stamps, stamp, n * sizeof *stamps);
    memcpy(poses, pose, n * sizeof *poses);
    *made = (cm_trajectory){n, stamps, poses};
    *trajectory = made;
    return CM_OK;
}

void cm_trajectory_destroy(cm_trajectory *trajectory)
{
    if (trajectory != NULL)
    {
        free(trajectory->stamp);
        free(trajectory->pose);
        free(trajectory);
    }
}

size_t cm_trajectory_count(const cm_trajectory *trajectory)
{
    return trajectory == NULL ? 0 : trajectory->count;
}

cm_status cm_trajectory_at(const cm_trajectory *trajectory, size_t index, double *stamp,
                           cm_pose *pose)
{
    if (trajectory == NULL || index >= trajectory->count)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (stamp != NULL)
    {
        *stamp = trajectory->stamp[index];
    }
    if (pose != NULL)
    {
        *pose = trajectory->pose[index];
    }
    return CM_OK;
}

cm_status cm_trajectory_nearest(const cm_trajectory *trajectory, double time, double apart,
                                size_t *index)
{
    if (trajectory == NULL || index == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const double *stamp = trajectory->stamp;
    const size_t before = cm_stamp_before(stamp, trajectory->count, time);
    const size_t after = before + 1 < trajectory->count ? before + 1 : before;
    const size_t nearest =
        cm_later_is_nearest(stamp[before], stamp[after], time, apart) ? after : before;
    if (!cm_stamps_within(stamp[nearest], time, apart))
    {
        return CM_ERROR_RANGE;
    }
    *index = nearest;
    return CM_OK;
}

cm_status cm_trajectory_interpolate(const cm_trajectory *trajectory, double time, cm_pose *pose)
{
    if (trajectory == NULL || pose == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const double *stamp = trajectory->stamp;
    const size_t last = trajectory->count - 1;
    if (!(time >= stamp[0] && time <= stamp[last]))
    {
        return CM_ERROR_RANGE;
    }
    const size_t i = cm_stamp_before(stamp, trajectory->count, time);
    if (i == last)
    {
        *pose = trajectory->pose[last];
        return CM_OK;
    }
    /* half of each, so that no difference of stamps overflows */
    const double t = (0.5 * time - 0.5 * stamp[i]) / (0.5 * stamp[i + 1] - 0.5 * stamp[i]);
    cm_pose_interpolate(&trajectory->pose[i], &trajectory->pose[i + 1], t, pose);
    return CM_OK;
}
