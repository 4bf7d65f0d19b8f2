/* SPDX-License-Identifier: MIT
 *
 * How snapshots are made and dropped.
 */
#ifndef MODULES_OCTREE_SNAPSHOT_H
#define MODULES_OCTREE_SNAPSHOT_H

#include "seen_tree.h"

/* What of a map is wanted, in voxels from the root's centre: a box, and a pyramid whose planes look inwards. Blocks that have
 * something of both, to `margin`, are taken whole. */
typedef struct cm_snapshot_bounds
{
    double least[3];
    double greatest[3];
    int planes;
    double plane[4][4]; /* a normal of length 1, and its product with a point of the plane */
    double margin;
} cm_snapshot_bounds;

/* The pool may be NULL. CM_OK; CM_ERROR_MEMORY; CM_ERROR_FILE, _DATA (pages). What was made is to be dropped, whatever is
 * returned. */
cm_status cm_snapshot_make(const cm_octree *octree, const cm_snapshot_bounds *bounds, cm_pool *pool,
                           cm_snapshot *snapshot);
void cm_snapshot_drop(cm_snapshot *snapshot);

#endif
