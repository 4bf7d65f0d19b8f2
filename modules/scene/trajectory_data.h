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

/* How much rounding to double may have added to the distance of two stamps, or taken from it: each may be off by half a unit
 * in its last place. No more than half of apart, however coarse stamps are. */
static inline double cm_stamps_rounding(double a, double b, double apart)
{
    const double rounding = DBL_EPSILON * (0.5 * fabs(a) + 0.5 * fabs(b) + 2.0 * apart);
    return rounding < 0.5 * apart ? rounding : 0.5 * apart;
}

/* Are two stamps at most apart seconds from each other, as they and apart were written? 1.02 and 1 are 0.020000000000000018
 * apart. */
static inline int cm_stamps_within(double a, double b, double apart)
{
    return fabs(a - b) <= apart + cm_stamps_rounding(a, b, apart);
}

/* Is the second at least apart seconds after the first, as they were written? 1.4 and 0.4 are 0.9999999999999999 apart. */
static inline int cm_stamps_reach(double first, double second, double apart)
{
    return second - first >= apart - cm_stamps_rounding(first, second, apart);
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
