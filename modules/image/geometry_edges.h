/* SPDX-License-Identifier: MIT
 *
 * Groups at the edges of planes: of the target's, which ends in the middle of blocks, and of the source's, where columns may
 * come again.
 */
#ifndef MODULES_IMAGE_GEOMETRY_EDGES_H
#define MODULES_IMAGE_GEOMETRY_EDGES_H

#include "group.h"

/* Pixels that the target's plane does not have leave a group of all. */
void cm_group_drop_beyond(const cm_surface *to, int derivatives, uint32_t block_column,
                          uint32_t block_row, cm_group *group);

/* Makes groups of a group of which the bounds are known, and which may be beyond the source's plane by more than slack: what
 * has gone round comes from the other end. Returns how many there are, 0 if places are beyond the plane. */
unsigned cm_group_settle(const cm_surface *from, int derivatives, double slack, cm_group *groups);

#endif
