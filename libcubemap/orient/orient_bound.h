/* SPDX-License-Identifier: MIT
 *
 * Points and tables of linear pieces, the sum over points of what a table says, and its bound over a box of rotations
 * (orient_bound.c; the sum itself is batch/orient_loops.inc).
 */
#ifndef LIBCUBEMAP_ORIENT_BOUND_H
#define LIBCUBEMAP_ORIENT_BOUND_H

#include "libcubemap/batch/batch_set.h"
#include "orient_boxes.h"

#include <math.h>

int cm_points_make(cm_orient_points *points, size_t count); /* 0 if there is no memory */
void cm_points_free(cm_orient_points *points);

int cm_table_make(cm_orient_table *table, unsigned side);
void cm_table_free(cm_orient_table *table);

/* p of u (CM_TABLE_BEND). */
static inline double cm_table_tangent(double u)
{
    const double a = 1.0 + CM_TABLE_BEND;
    const double size = u < 0.0 ? -u : u;
    const double p = size > 1.0 ? 1.0 + (size - 1.0) / (1.0 - CM_TABLE_BEND)
                                : 2.0 * size / (a + sqrt(a * a - 4.0 * CM_TABLE_BEND * size));
    return u < 0.0 ? -p : p;
}

/* The unit direction of (u, v) on a face of the table. */
void cm_table_direction(unsigned face, double u, double v, double direction[3]);

/* That of the middle of a piece, by its number. */
void cm_table_middle(unsigned side, unsigned piece, double direction[3]);

/* The number of the piece that a direction is in. */
int cm_table_locate(const double direction[3], unsigned side);

/* The sum over the points, turned by a rotation, of what the table says; and a bound of it for all rotations of a box.
 * With back the points are turned back. */
double cm_orient_sum(const cm_batch_set *set, const cm_orient_points *points,
                     const cm_orient_table *table, int back, const cm_quaternion *at);
double cm_orient_bound(const cm_batch_set *set, const cm_orient_points *points,
                       const cm_orient_table *table, int back, const cm_box_shape *shape);

#endif
