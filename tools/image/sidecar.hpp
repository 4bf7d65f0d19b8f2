// SPDX-License-Identifier: MIT
//
// A file beside pictures that says what they are, for programs that do not read their tags.

#ifndef CUBEMAP_TOOLS_SIDECAR_HPP
#define CUBEMAP_TOOLS_SIDECAR_HPP

#include "surface_tags.hpp"

#include <cubemap/image.h>

#include <optional>
#include <string>
#include <vector>

// "face_%f.png": "face.json"
std::string sidecar_name(const std::string &output);

// JSON, of one object.
std::string sidecar_text(const cm_surface &surface, const std::optional<cm_rotation> &rotation,
                         const std::vector<std::string> &pictures, const std::string &filter);

// What the file beside INPUT says, if picture is one of those that it names; nothing if there is no such file.
std::optional<SavedSurface> surface_beside(const std::string &input, const std::string &picture);

// What such a file says. Failure if it is none.
SavedSurface read_sidecar(const std::string &path);

#endif
