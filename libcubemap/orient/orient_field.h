/* SPDX-License-Identifier: MIT
 *
 * Distortion as a field on the sphere, and its table (orient_field.c).
 */
#ifndef LIBCUBEMAP_ORIENT_FIELD_H
#define LIBCUBEMAP_ORIENT_FIELD_H

#include "orient_task.h"

/* Field and scale of n directions; not finite where there is none. */
void cm_field_values(const cm_orient_task *task, size_t n, const double *x, const double *y,
                     const double *z, double *field, double *scale);

/* The table of the field less best, times the scale where that counts: linear pieces of which the field is never
 * below within reach. threads as in the task. *least_scale as in cm_orient_level. */
int cm_field_table(const cm_orient_task *task, double reach, double turn, double best,
                   cm_orient_table *table, double *least_scale);

/* Does the measure stay with this turn of the cube? */
int cm_field_is_kept(const cm_orient_task *task, const cm_quaternion *turn);

#endif
