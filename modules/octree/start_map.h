/* SPDX-License-Identifier: MIT
 *
 * Where cones from one point need not be traced: a cube map of the nearest and the farthest that a snapshot has in each square
 * of directions, of whatever camera is there.
 */
#ifndef MODULES_OCTREE_START_MAP_H
#define MODULES_OCTREE_START_MAP_H

#include "cone.h"

/* Squares along an edge of a face: some 1.1 degrees. */
#define CM_START_EDGE 80

typedef struct cm_start_map
{
    float begin[6][CM_START_EDGE][CM_START_EDGE]; /* infinite where nothing is */
    float end[6][CM_START_EDGE][CM_START_EDGE];
} cm_start_map;

/* Of cones from a place, in voxels from the snapshot's corner, that are at most so wide and read levels from coarsest on. */
void cm_start_map_make(const cm_snapshot *snapshot, const double origin[3], double width,
                       int coarsest, double far, cm_start_map *map);

/* Shorten a cone. 0: nothing is there. */
int cm_start_map_shorten(const cm_start_map *map, cm_cone *cone);

#endif
