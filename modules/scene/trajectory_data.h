/* SPDX-License-Identifier: MIT
 *
 * What a trajectory is made of.
 */
#ifndef MODULES_SCENE_TRAJECTORY_DATA_H
#define MODULES_SCENE_TRAJECTORY_DATA_H

#include <cubemap/trajectory.h>

#include <float.h>
#include <math.h>

struct cm_trajectory
{
    size_t count;
    double *stamp; /* increasing */
    cm_pose *pose;
};

/* Are two stamps at most apart seconds from each other, as they and apart were written? Each may be off by half a unit in its
 * last place: 1.02 and 1 are 0.020000000000000018 apart. No more than half of apart is added, however coarse stamps are. */
static inline int cm_stamps_within(double a, double b, double apart)
{
    const double rounding = DBL_EPSILON * (0.5 * fabs(a) + 0.5 * fabs(b) + 2.0 * apart);
    return fabs(a - b) <= apart + (rounding < 0.5 * apart ? rounding : 0.5 * apart);
}

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
