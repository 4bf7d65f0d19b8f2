/* SPDX-License-Identifier: MIT
 *
 * Updates by cameras with distortion or a mapping.
 */
#ifndef MODULES_OCTREE_UPDATE_ROUND_H
#define MODULES_OCTREE_UPDATE_ROUND_H

#include "update_desk.h"

/* As the update of a straight camera, after cm_view_desk_clean. */
cm_status cm_update_round(cm_update *update, cm_pool *pool);

#endif
