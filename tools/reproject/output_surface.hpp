// SPDX-License-Identifier: MIT
//
// What OUTPUT is to be, and how large.

#ifndef CUBEMAP_TOOLS_OUTPUT_SURFACE_HPP
#define CUBEMAP_TOOLS_OUTPUT_SURFACE_HPP

#include "reproject_input.hpp"

// The surface of OUTPUT. UsageFailure if the command line asks for what is none.
SurfacePointer output_surface(const Options &options, const Input &input);

#endif
