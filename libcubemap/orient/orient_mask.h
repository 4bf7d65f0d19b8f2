/* SPDX-License-Identifier: MIT
 *
 * The mask as points and as a table (orient_mask.c), and the edges of faces.
 */
#ifndef LIBCUBEMAP_ORIENT_MASK_H
#define LIBCUBEMAP_ORIENT_MASK_H

#include "orient_task.h"

/* The mask's pixels that count, or with per_face > 0 their means in so many by so many cells of a cube's face. */
int cm_mask_points(const cm_orient_task *task, unsigned per_face, cm_orient_points *points);

/* The edges of the mapping's faces in pieces of at most so many radians. */
int cm_edge_points(const cm_mapping *mapping, double length, cm_orient_points *points,
                   double *whole);

/* The mask's value at a direction, between pixels bilinear. */
double cm_mask_at(const cm_mask *mask, const double direction[3]);
double cm_mask_at_lonlat(const cm_mask *mask, double lon, double lat); /* radians */

/* The table of what a mask is no less than within reach of the piece's centre, less best; and of what it is at the
 * centre. */
int cm_mask_table(const cm_orient_task *task, double reach, double best, cm_orient_table *table);
void cm_plain_table(const cm_orient_task *task, cm_orient_table *table);

#endif
