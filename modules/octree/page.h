/* SPDX-License-Identifier: MIT
 *
 * Regions as blobs of a store.
 */
#ifndef MODULES_OCTREE_PAGE_H
#define MODULES_OCTREE_PAGE_H

#include "voxel_region.h"

/* The region at a place, as it was put; CM_ERROR_DATA if there is none. */
cm_status cm_page_get(const cm_octree *octree, cm_store *store, const uint32_t place[3],
                      cm_region **region);

/* Put it there. Its blocks are packed. */
cm_status cm_page_put(const cm_octree *octree, cm_store *store, cm_region *region);

/* It is no region any more. */
cm_status cm_page_remove(cm_store *store, const uint32_t place[3]);

#endif
