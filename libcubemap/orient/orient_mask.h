/* SPDX-License-Identifier: MIT
 *
 * The mask as points and as a table (orient_mask.c).
 */
#ifndef LIBCUBEMAP_ORIENT_MASK_H
#define LIBCUBEMAP_ORIENT_MASK_H

#include "orient_task.h"

/* The mask's pixels that count, or with per_face > 0 their means in so many by so many cells of a cube's face. */
int cm_mask_points(const cm_orient_task *task, unsigned per_face, cm_orient_points *points);

/* The table of what a mask is no less than within reach of the piece's centre, less best; and of its mean in the
 * piece. */
int cm_mask_table(const cm_orient_task *task, double reach, double best, cm_orient_table *table);
void cm_plain_table(const cm_orient_task *task, cm_orient_table *table);

#endif
