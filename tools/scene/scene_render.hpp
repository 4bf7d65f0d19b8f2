// SPDX-License-Identifier: MIT
//
// cubemap-scene render: the views of a trajectory, as a folder.

#ifndef CUBEMAP_TOOLS_SCENE_RENDER_HPP
#define CUBEMAP_TOOLS_SCENE_RENDER_HPP

#include "tools/cli/streams.h"

int render_scene(int argc, char **argv, const cm_streams &streams);

#endif
