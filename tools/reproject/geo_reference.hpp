// SPDX-License-Identifier: MIT
//
// TIFF files that say where on Earth their pixels are.

#ifndef CUBEMAP_TOOLS_GEO_REFERENCE_HPP
#define CUBEMAP_TOOLS_GEO_REFERENCE_HPP

#include "tools/cli/image_file.hpp"

#include <optional>
#include <string>

// The specification of the surface of a file that is placed by longitude and latitude (EPSG:4326); nothing if it does not
// say where it is. Failure, with what is to be done, if it is placed in another way.
std::optional<std::string> geographic_surface(const ImageFile &image);

#endif
