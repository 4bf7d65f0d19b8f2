/* SPDX-License-Identifier: MIT
 *
 * Which voxels of a block are occupied, as bits in the order of keys.
 */
#ifndef MODULES_OCTREE_BLOCK_MASK_H
#define MODULES_OCTREE_BLOCK_MASK_H

#include "voxel_region.h"

/* The voxels of level 0, whatever the block's detail is. more: misses that wait above the region. Returns 0 if there is none. */
int cm_block_mask(const cm_region *region, unsigned block, const cm_count_rule *rule, unsigned more,
                  uint64_t mask[8]);

#endif
