// SPDX-License-Identifier: MIT
//
// The commands of cubemap-octree. Each takes its name and what follows, and returns the exit status, or throws a Failure.

#ifndef CUBEMAP_TOOLS_OCTREE_COMMAND_HPP
#define CUBEMAP_TOOLS_OCTREE_COMMAND_HPP

#include "tools/cli/streams.h"

int integrate_views(int argc, char **argv, const cm_streams &streams);
int query_octree(int argc, char **argv, const cm_streams &streams);
int cast_octree_rays(int argc, char **argv, const cm_streams &streams);
int extract_octree(int argc, char **argv, const cm_streams &streams);
int render_octree(int argc, char **argv, const cm_streams &streams);
int probe_octree(int argc, char **argv, const cm_streams &streams);
int merge_octrees(int argc, char **argv, const cm_streams &streams);
int carve_hull(int argc, char **argv, const cm_streams &streams);
int tell_octree(int argc, char **argv, const cm_streams &streams);

#endif
