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

/* Between what the distance of two stamps is, as they were written. */
typedef struct cm_stamps_distance
{
    double least;
    double most;
} cm_stamps_distance;

/* Each stamp by half a unit in its own last place, no more, so that microseconds of our time are told apart. Stamps that are
 * equal are so as they were written; of others the distance is at least half of what it seems. */
static inline cm_stamps_distance cm_stamps_apart(double a, double b)
{
    const double units =
        (nextafter(fabs(a), DBL_MAX) - fabs(a)) + (nextafter(fabs(b), DBL_MAX) - fabs(b));
    const double apart = fabs(a - b);
    const double rounding = 0.5 * units + 2.0 * DBL_EPSILON * apart;
    cm_stamps_distance made;
    made.least = fmax(apart - rounding, 0.5 * apart); /* fmax and fmin: apart may be infinite */
    made.most = fmin(apart + rounding, 1.5 * apart);
    return made;
}

/* Is the later of two stamps the nearest to time? Not if the earlier one may be as near, but if only the later one is at most
 * apart seconds away. */
static inline int cm_later_is_nearest(double earlier, double later, double time, double apart)
{
    return cm_stamps_apart(later, time).most < cm_stamps_apart(earlier, time).least ||
           !cm_stamps_within(earlier, time, apart);
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
