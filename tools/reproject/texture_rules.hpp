// SPDX-License-Identifier: MIT
//
// What the formats of renderers prescribe: textures are a picture, or a cube map whose faces are those of the frame gl.

#ifndef CUBEMAP_TOOLS_TEXTURE_RULES_HPP
#define CUBEMAP_TOOLS_TEXTURE_RULES_HPP

#include "reproject_options.hpp"
#include "tools/cli/image_format.hpp"
#include "tools/image/texture_faces.hpp"

// "dds" or "ktx2" by a name's extension, else "".
std::string texture_format(const std::string &path);

// The format of any output by its name's extension. UsageFailure if it is none that is written.
std::string reproject_format(const std::string &path);

// OUTPUT as its format wants it, as far as the command line does not say it: as --for directx. UsageFailure if it says
// what such a file cannot be.
void take_texture_rules(Options &options);

// A plan for a texture that comes from such an image. Failure if a texture holds no such pixels.
void plan_texture(ImagePlan &plan, const std::string &path);

#endif
