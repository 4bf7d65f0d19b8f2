/* SPDX-License-Identifier: MIT
 *
 * The measure itself, and following it downhill (orient_value.c).
 */
#ifndef LIBCUBEMAP_ORIENT_VALUE_H
#define LIBCUBEMAP_ORIENT_VALUE_H

#include "orient_task.h"

/* The measure over points, a mean, infinite if no point has a value; of edges, for which no points are needed, the part
 * of their length that is over the mask, times the mask's value. NaN if there is no memory. */
double cm_task_value(const cm_orient_task *task, const cm_orient_points *points,
                     const cm_rotation *rotation);

/* A function of rotations, and following it downhill in steps from step to least, radians. Returns the value there, NaN
 * as soon as it is NaN anywhere: there is no memory. */
typedef double (*cm_orient_function)(const void *of, const cm_quaternion *at);
double cm_descend(cm_orient_function function, const void *of, double step, double least,
                  cm_quaternion *rotation);

/* All rotations that are up to so many steps from one, along each of three axes: of those that are no more than their
 * neighbours the best ones are followed downhill, in steps from half of step to least, radians. */
typedef struct cm_orient_grid
{
    double step;
    int steps;
    int bottoms; /* that are followed */
    double least;
} cm_orient_grid;

/* The least that is found so, or at the rotation itself. NaN as cm_descend. The function is called from threads. */
double cm_look_about(cm_orient_function function, const void *of, unsigned threads,
                     const cm_orient_grid *grid, cm_quaternion *rotation);

#endif
