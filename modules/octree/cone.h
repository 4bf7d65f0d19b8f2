/* SPDX-License-Identifier: MIT
 *
 * Cones through a snapshot: what they meet on the way, from front to back.
 *
 *   units     of lengths: voxels of level 0; of places: from the snapshot's corner
 *   level     that is read: the finest whose cells are not less wide than half the cone, never above it
 *   voxels    of level 0 are opaque where a cone enters them. Cells above add their opacity, weighted by the squares of the
 *             direction's coordinates, as evenly as the cone goes through them
 */
#ifndef MODULES_OCTREE_CONE_H
#define MODULES_OCTREE_CONE_H

#include "seen_tree.h"

typedef struct cm_cone
{
    double origin[3];
    double direction[3]; /* of length 1 */
    double width;        /* at distance 1 */
    double begin;        /* how far from the origin it is traced from, and to */
    double end;
    int coarsest; /* the finest level that is read */
} cm_cone;

/* What a cone met. */
typedef struct cm_cone_view
{
    float opacity;
    float color[3];   /* times opacity; 0 to 1 */
    double half;      /* where the opacity passes one half; infinite if it does not */
    int level;        /* of the cell that is there */
    int32_t place[3]; /* and a voxel of it */
} cm_cone_view;

/* The nodes above the place that was looked at last: others are near. Nothing depends on it but time. To begin with cm_cone_start. */
typedef struct cm_cone_path
{
    uint32_t place[3];
    const cm_seen_node *node[CM_SNAPSHOT_STAGES];
    int stage; /* the lowest whose node is known */
} cm_cone_path;

/* The cell of a level that has a place, or why there is none. */
typedef struct cm_cone_cell
{
    const cm_seen_cell *cell; /* NULL: nothing, or a voxel */
    const uint32_t *color;    /* of a voxel; NULL: nothing */
    int level;                /* of the cell, or of a cube with nothing in it */
} cm_cone_cell;

void cm_cone_start(const cm_snapshot *snapshot, cm_cone_path *path);

/* place is inside of the snapshot. */
cm_cone_cell cm_cone_look(const cm_snapshot *snapshot, cm_cone_path *path, const uint32_t place[3],
                          int level);

/* All that a cone meets, until it is opaque. */
cm_cone_view cm_cone_trace(const cm_snapshot *snapshot, cm_cone_path *path, const cm_cone *cone);

#endif
