/* SPDX-License-Identifier: MIT
 *
 * What a trajectory is made of.
 */
#ifndef MODULES_SCENE_TRAJECTORY_DATA_H
#define MODULES_SCENE_TRAJECTORY_DATA_H

#include <cubemap/trajectory.h>

struct cm_trajectory
{
    size_t count;
    double *stamp; /* increasing */
    cm_pose *pose;
};

/* The last of count stamps that is not after time; 0 if all are. */
static inline size_t cm_stamp_before(const double *stamp, size_t count, double time)
{
    size_t low = 0;
    size_t high = count;
    while (high - low > 1)
    {
        const size_t middle = low + (high - low) / 2;
        if (stamp[middle] <= time)
        {
            low = middle;
        }
        else
        {
            high = middle;
        }
    }
    return low;
}

#endif
