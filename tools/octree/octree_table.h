/* SPDX-License-Identifier: MIT
 *
 * What the options of cubemap-octree are called in its source, and its commands.
 */
#ifndef CUBEMAP_TOOLS_OCTREE_TABLE_H
#define CUBEMAP_TOOLS_OCTREE_TABLE_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

enum
{
    OCTREE_OUTPUT = 1,
    OCTREE_EDGE,
    OCTREE_CENTRE,
    OCTREE_LEVELS,
    OCTREE_COLOR,
    OCTREE_FOOTPRINT,
    OCTREE_MEMORY,
    OCTREE_NOISE,
    OCTREE_NEAR,
    OCTREE_FAR,
    OCTREE_NO_RETURN_FREE,
    OCTREE_ENDPOINTS_ONLY,
    OCTREE_LOG_ODDS,
    OCTREE_BUDGET,
    OCTREE_CAMERA,
    OCTREE_SAVE_EVERY,
    OCTREE_LEVEL,
    OCTREE_FORMAT,
    OCTREE_DEPTH,
    OCTREE_LIGHT,
    OCTREE_MESH,
    OCTREE_MESH_POSE,
    OCTREE_AT,
    OCTREE_TO,
    OCTREE_SIZE,
    OCTREE_POSE,
    OCTREE_OUTSIDE,
    OCTREE_THREADS,
    OCTREE_JSON,
    OCTREE_QUIET
};

extern const cm_command octree_integrate_command;
extern const cm_command octree_query_command;
extern const cm_command octree_ray_command;
extern const cm_command octree_extract_command;
extern const cm_command octree_render_command;
extern const cm_command octree_probe_command;
extern const cm_command octree_merge_command;
extern const cm_command octree_hull_command;
extern const cm_command octree_info_command;

#ifdef __cplusplus
}
#endif

#endif
