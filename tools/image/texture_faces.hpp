// SPDX-License-Identifier: MIT
//
// Cube maps in textures, of which the format says how their faces lie.

#ifndef CUBEMAP_TOOLS_TEXTURE_FACES_HPP
#define CUBEMAP_TOOLS_TEXTURE_FACES_HPP

#include "surface_tags.hpp"

#include <string>

bool is_texture(const std::string &format);

// What a cube map is whose file does not say it; Direct3D, OpenGL and Vulkan have one table of faces.
SavedSurface texture_surface();

// Are the file's six pictures the faces of a cube?
bool has_six_faces(const ImageFile &image);

#endif
