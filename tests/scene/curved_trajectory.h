/* SPDX-License-Identifier: MIT
 *
 * A trajectory on a known curve, for the suites of trajectories and of motion.
 */
#ifndef TESTS_SCENE_CURVED_TRAJECTORY_H
#define TESTS_SCENE_CURVED_TRAJECTORY_H

#include <cubemap/trajectory.h>

#include "tests/suite.h"

enum
{
    COUNT = 200
};

static double stamps[COUNT];
static cm_pose poses[COUNT];

/* A curve with known derivatives, turning about a fixed axis. */
static inline void place_at(double t, double place[3])
{
    place[0] = 2.0 * cos(0.7 * t);
    place[1] = 1.5 * sin(0.7 * t);
    place[2] = 0.3 * sin(1.3 * t);
}

static inline void fill(double begin, double step)
{
    for (int i = 0; i < COUNT; i++)
    {
        const double t = step * i;
        double twist[6] = {0.0, 0.0, 0.0, 0.3 * sin(t), 0.6 * sin(t), -0.2 * sin(t)};
        cm_pose_exp(twist, &poses[i]);
        place_at(t, poses[i].position);
        stamps[i] = begin + t;
    }
}

static inline cm_trajectory *make(size_t n, const double *stamp, const cm_pose *pose)
{
    cm_trajectory *made = NULL;
    ck_assert_int_eq(cm_trajectory_create(n, stamp, pose, &made, NULL), CM_OK);
    return made;
}

static inline double apart(const cm_pose *a, const cm_pose *b)
{
    double worst = 0.0;
    for (int i = 0; i < 9; i++)
    {
        worst = fmax(worst, fabs(a->rotation.row[i / 3][i % 3] - b->rotation.row[i / 3][i % 3]));
        worst = fmax(worst, fabs(a->position[i / 3] - b->position[i / 3]));
    }
    return worst;
}

#endif
