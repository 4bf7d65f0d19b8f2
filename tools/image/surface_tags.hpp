// SPDX-License-Identifier: MIT
//
// What image files say of the surface that they are pictures of, in tags that formats can hold: "cubemap:surface", a
// specification, and "cubemap:rotation", LON,LAT,ROLL. Formats without tags of a program's own have them as lines
// NAME=VALUE in the description; PFM has neither. Equirectangular images have the fields of a photo sphere, too.

#ifndef CUBEMAP_TOOLS_SURFACE_TAGS_HPP
#define CUBEMAP_TOOLS_SURFACE_TAGS_HPP

#include "tools/cli/image_file.hpp"
#include "tools/cli/image_format.hpp"

#include <cubemap/image.h>

#include <optional>
#include <string>

// What a file says.
struct SavedSurface
{
    std::string specification;
    std::optional<cm_rotation> rotation;
    std::string where; // the file beside the picture that says it; "": the picture itself
};

// What has become of the size that a picture had when it was said what it is.
enum class SizeThen
{
    same,
    scaled, // or cut to the same shape, which looks alike
    cut     // to another shape
};

SizeThen size_of_then(const SavedSurface &saved, const ImageFile &image);

// Nothing if it says nothing, or what nobody understands.
std::optional<SavedSurface> saved_surface(const ImageFile &image);

// Says it, in place of what the source has said.
void save_surface(ImagePlan &plan, const cm_surface &surface,
                  const std::optional<cm_rotation> &rotation);

#endif
