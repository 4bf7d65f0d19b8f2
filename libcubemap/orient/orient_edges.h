/* SPDX-License-Identifier: MIT
 *
 * The edges of a mapping's faces: in pieces, as points, and as arcs whose length over the mask's pixels is found exactly
 * (orient_edges.c).
 */
#ifndef LIBCUBEMAP_ORIENT_EDGES_H
#define LIBCUBEMAP_ORIENT_EDGES_H

#include "orient_task.h"

/* The edges in pieces of at most so many radians, each as the point in its middle, and the length of them all, radians.
 * 0 without memory. */
int cm_edge_points(const cm_mapping *mapping, double length, cm_orient_points *points,
                   double *whole);

/* The task's edges, their length, and where its mask's pixels end. 0 without memory. */
int cm_edges_make(cm_orient_task *task);
void cm_edges_free(cm_orient_task *task);

/* The length of the edges of the turned cube over the mask, radians, times the mask's values. */
double cm_edges_over_mask(const cm_orient_task *task, const cm_rotation *rotation);

#endif
