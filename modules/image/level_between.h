/* SPDX-License-Identifier: MIT
 *
 * Values between the pixels of a level's planes, by six points each way where there are so many.
 */
#ifndef MODULES_IMAGE_LEVEL_BETWEEN_H
#define MODULES_IMAGE_LEVEL_BETWEEN_H

#include "level_object.h"

/* A value from inside a plane. A polynomial does not go across a crease, which are on diagonals, but by two points. */
void cm_level_between(const cm_level *level, int is_creased, unsigned plane, double x, double y,
                      unsigned char *to);

/* Where six pixels each way begin, of bytes or floats as they are stored, if all that the loops of cm_filter_set read of them
 * is there; else NULL. */
const void *cm_level_six_at(const cm_level *level, unsigned plane, int32_t left, int32_t top);

#endif
