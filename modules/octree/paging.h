/* SPDX-License-Identifier: MIT
 *
 * Regions that come from pages and go there.
 */
#ifndef MODULES_OCTREE_PAGING_H
#define MODULES_OCTREE_PAGING_H

#include "node_tree.h"

/* The region of a node at CM_REGION_LEVEL, in memory, with nothing waiting above its blocks; it is made of a leaf, and got from
 * pages. */
cm_status cm_node_region(cm_octree *octree, uint32_t node, const uint32_t place[3],
                         cm_region **region);

/* The region of a node for reading; from pages, what is there goes back into memory. Misses that wait stay where they are. */
cm_status cm_node_look(const cm_octree *octree, uint32_t node, const uint32_t place[3],
                       const cm_region **region);

/* Regions that were not used for longest go to pages until those in memory take what options.memory says, but those that were
 * used in this step stay. */
cm_status cm_pages_trim(cm_octree *octree);

#endif
