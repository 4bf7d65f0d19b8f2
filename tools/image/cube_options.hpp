// SPDX-License-Identifier: MIT
//
// Options that say how the faces of a cube sit on the axes and in pictures.

#ifndef CUBEMAP_TOOLS_CUBE_OPTIONS_HPP
#define CUBEMAP_TOOLS_CUBE_OPTIONS_HPP

#include "cube_image.hpp"
#include "tools/cli/program.hpp"

// The value of an option: faces, strip, cross, or cross:north=N,south=N. UsageFailure if it is none.
CubeLayout read_layout(OptionReader &reader, PolarColumns &columns);

// "faces", "strip", "cross"
const char *layout_name(CubeLayout layout);

#endif
