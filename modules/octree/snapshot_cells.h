/* SPDX-License-Identifier: MIT
 *
 * The cells of a snapshot's nodes: averages of what is below them.
 */
#ifndef MODULES_OCTREE_SNAPSHOT_CELLS_H
#define MODULES_OCTREE_SNAPSHOT_CELLS_H

#include "seen_tree.h"

/* From a node's mask all that follows of it: which cells there are. Returns how many. */
size_t cm_seen_node_count(cm_seen_node *node);

/* A voxel's color; that of those that have none is grey. */
void cm_seen_color(uint32_t color, uint8_t rgb[3]);

/* What cells of blocks are made of by tables. */
void cm_seen_tables(cm_snapshot *snapshot);

/* The cells of a block and of a node above, whose children have theirs. */
void cm_seen_block_fill(const cm_snapshot *snapshot, const cm_seen_node *node);
void cm_seen_node_fill(const cm_snapshot *snapshot, int stage, const cm_seen_node *node);

#endif
