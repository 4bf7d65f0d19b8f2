/* SPDX-License-Identifier: MIT
 *
 * What stands for pixels beyond the end of a map where the sphere is not shown: the map's own last pixels, continued along
 * a line. A filter there is then one-sided, and true of slopes and bends, where the last pixel alone has half a pixel's slope
 * as its error.
 */
#ifndef MODULES_IMAGE_LEVEL_RIM_H
#define MODULES_IMAGE_LEVEL_RIM_H

#include "level_object.h"

static inline int32_t cm_level_least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* Pixels that a value is continued from, and their weights, whose sum is 1. */
#define CM_RIM_NODES 3

typedef struct cm_rim_nodes
{
    int32_t count;
    int32_t from_last[CM_RIM_NODES]; /* pixels from the last one inwards */
    float weight[CM_RIM_NODES];
} cm_rim_nodes;

/* For what is `away` pixels beyond the last one, of which there are `room` more before it. Near by it is a parabola,
 * farther the mirror image about the last pixel: whatever the distance, rounding is magnified 4.4 times at most. */
cm_rim_nodes cm_rim_nodes_at(int32_t away, int32_t room);

/* The same for a pixel of a line from 0 to before extent, or beyond: the last pixel before it, and which way is inwards, 1
 * or -1. If it does not go on, the last pixel alone; so for one that is not beyond. */
cm_rim_nodes cm_rim_nodes_along(int32_t at, uint32_t extent, int goes_on, int32_t *last,
                                int32_t *inwards);

/* Is a value of these to be continued? Not opacity, nor the weight of pixels that count, which are from 0 to 1. */
int cm_rim_goes_on(const cm_values *values);

/* The value for a pixel beyond the edges of a plane without gaps. */
void cm_level_continue_edge(const cm_level *level, unsigned plane, int32_t column, int32_t row,
                            unsigned char *to);

/* The value for a pixel off the map, from the rows, columns and diagonals on which the map is nearest: their mean. 0 if
 * it is not within reach on any. */
int cm_level_continue_rim(const cm_level *level, const cm_gaps *gaps, unsigned plane,
                          int32_t column, int32_t row, int32_t reach, unsigned char *to);

#endif
