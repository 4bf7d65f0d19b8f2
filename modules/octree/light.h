/* SPDX-License-Identifier: MIT
 *
 * The virtual light of a picture: how bright a surface is.
 */
#ifndef MODULES_OCTREE_LIGHT_H
#define MODULES_OCTREE_LIGHT_H

#include "cone.h"

typedef struct cm_light
{
    double place[3]; /* in voxels from the snapshot's corner */
    double width;    /* of the shadow's cone at distance 1 */
    double ambient;  /* 0 to 1 */
    int coarsest;
} cm_light;

/* What was read around the last places: those of pixels beside one another are mostly the same. To begin with zeros. */
typedef struct cm_light_windows
{
    struct
    {
        int32_t first[3];
        int level; /* 0: none */
        float part[27];
    } window[2];
} cm_light_windows;

/* Towards the viewer who looks in a direction: against the gradient of what is occupied around a place, of length 1. In the cells
 * twice as large as those of the level, since a wall of one voxel has no gradient of its own. */
void cm_light_normal(const cm_snapshot *snapshot, cm_cone_path *path, cm_light_windows *windows,
                     const double place[3], const double direction[3], int level, double normal[3]);

/* Of a place that is as far from shadow as a cell of the level: 0 to 1. normal NULL: of what looks to the light. */
double cm_light_at(const cm_light *light, const cm_snapshot *snapshot, cm_cone_path *path,
                   const double place[3], const double normal[3], int level);

#endif
