// SPDX-License-Identifier: MIT
//
// The commands of cubemap-tof. Each takes its name and what follows, and returns the exit status, or throws a Failure.

#ifndef CUBEMAP_TOOLS_TOF_COMMAND_HPP
#define CUBEMAP_TOOLS_TOF_COMMAND_HPP

#include "tools/cli/streams.h"

int simulate_tof(int argc, char **argv, const cm_streams &streams);
int evaluate_tof(int argc, char **argv, const cm_streams &streams);
int render_texels(int argc, char **argv, const cm_streams &streams);
int reproduce_papers(int argc, char **argv, const cm_streams &streams);

#endif
