// SPDX-License-Identifier: MIT
//
// OpenEXR files that are written with a face a part.

#ifndef CUBEMAP_TOOLS_PART_RULES_HPP
#define CUBEMAP_TOOLS_PART_RULES_HPP

#include "reproject_options.hpp"

#include <string>
#include <vector>

// UsageFailure if --parts is said of an OUTPUT that cannot have any.
void check_parts(const Options &options);

// The names of the parts of such an OUTPUT, those of the frame's faces. UsageFailure if it is not six faces.
std::vector<std::string> part_names(const cm_surface &surface);

#endif
