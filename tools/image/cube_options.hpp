// SPDX-License-Identifier: MIT
//
// Options that say how the faces of a cube sit on the axes and in pictures.

#ifndef CUBEMAP_TOOLS_CUBE_OPTIONS_HPP
#define CUBEMAP_TOOLS_CUBE_OPTIONS_HPP

#include "cube_image.hpp"
#include "tools/cli/program.hpp"

// The values of options; UsageFailure if they are none.
CubeLayout read_layout(ArgumentReader &reader);
CubeLayout read_layout(ArgumentReader &reader, PolarColumns &columns); // cross:north=N,south=N, too
const cm_frame *read_frame(ArgumentReader &reader);

// "faces", "strip", "cross"
const char *layout_name(CubeLayout layout);

#endif
