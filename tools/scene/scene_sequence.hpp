// SPDX-License-Identifier: MIT
//
// cubemap-scene info, convert and evaluate: what sequences and trajectories have.

#ifndef CUBEMAP_TOOLS_SCENE_SEQUENCE_HPP
#define CUBEMAP_TOOLS_SCENE_SEQUENCE_HPP

#include "tools/cli/streams.h"

int tell_scene(int argc, char **argv, const cm_streams &streams);
int convert_scene(int argc, char **argv, const cm_streams &streams);
int evaluate_scene(int argc, char **argv, const cm_streams &streams);

#endif
