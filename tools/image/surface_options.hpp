// SPDX-License-Identifier: MIT
//
// How the sphere lies on pictures, as a command line says it.

#ifndef CUBEMAP_TOOLS_SURFACE_OPTIONS_HPP
#define CUBEMAP_TOOLS_SURFACE_OPTIONS_HPP

#include <cubemap/image.h>

#include <optional>
#include <string>

// What the command line says of a surface; what it does not say is empty.
struct SurfaceOptions
{
    std::string specification; // one that the library takes, if sizes are left aside
    std::string frame;
    std::string layout;
    std::optional<cm_rotation> rotation;
    std::optional<cm_rotation> said_rotation; // by the file that has said the rest
};

#endif
