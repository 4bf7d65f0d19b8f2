// SPDX-License-Identifier: MIT
//
// A file beside pictures that says what they are, for programs that do not read their tags.

#ifndef CUBEMAP_TOOLS_SIDECAR_HPP
#define CUBEMAP_TOOLS_SIDECAR_HPP

#include <cubemap/image.h>

#include <optional>
#include <string>
#include <vector>

// "face_%f.png": "face.json"
std::string sidecar_name(const std::string &output);

// JSON, of one object.
std::string sidecar_text(const cm_surface &surface, const std::optional<cm_rotation> &rotation,
                         const std::vector<std::string> &pictures, const std::string &filter);

#endif
