/* SPDX-License-Identifier: MIT
 *
 * The nodes above regions.
 */
#ifndef MODULES_OCTREE_NODE_TREE_H
#define MODULES_OCTREE_NODE_TREE_H

#include "voxel_region.h"

/* Where a place is found: the node at which the tree ends there, a leaf or a region, and the misses that wait in nodes above
 * it and in itself, if it is a region. */
typedef struct cm_spot
{
    uint32_t node;
    int level;
    unsigned misses;
} cm_spot;

/* The root, a leaf of what is unknown. 0 if there is no memory. */
int cm_nodes_make(cm_octree *octree);
void cm_nodes_drop(cm_octree *octree);

/* The finest node at a place, in voxels. */
cm_spot cm_node_find(const cm_octree *octree, const uint32_t place[3]);

/* A leaf becomes an inner node with eight leaves; what waits in an inner node is brought down to its children. 0 if there is no
 * memory: nothing changes. */
int cm_node_divide(cm_octree *octree, uint32_t node);

/* What waits in a node is brought down, whatever it is; leaves have nothing. */
void cm_node_push(cm_octree *octree, uint32_t node);

/* Misses of all that a node has. */
void cm_node_miss(cm_octree *octree, uint32_t node, unsigned misses);

/* A region that was made or got becomes that of a node, which keeps the misses that wait. It is given back on failure. */
cm_status cm_node_take_region(cm_octree *octree, uint32_t node, cm_region *region);

/* A node becomes a leaf, and all below it is given back. */
void cm_node_close(cm_octree *octree, uint32_t node, uint8_t alpha);

/* If the region of a node is even the node becomes a leaf, which changed when the last of the region's blocks did. Its page goes,
 * so that a store has no more pages than the map has regions: the status is that of pages, and the map is whole in any case. */
cm_status cm_node_close_even(cm_octree *octree, uint32_t node);

/* Nodes of whom all eight children are equal leaves become leaves. */
void cm_nodes_join(cm_octree *octree);

/* The region of a node is put away: it keeps its place in the tree. */
void cm_node_forget_region(cm_octree *octree, uint32_t node);

/* Go down to a cube of 2^level voxels, level CM_REGION_LEVEL or more: its node. CM_ERROR_MEMORY. */
cm_status cm_node_reach(cm_octree *octree, const uint32_t place[3], int level, uint32_t *node);

#endif
