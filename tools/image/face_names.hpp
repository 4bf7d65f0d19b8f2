// SPDX-License-Identifier: MIT
//
// The names of files that hold a face each.

#ifndef CUBEMAP_TOOLS_FACE_NAMES_HPP
#define CUBEMAP_TOOLS_FACE_NAMES_HPP

#include <string>
#include <vector>

// The names of six faces: 0 to 5 in place of %f, or else before the extension.
std::vector<std::string> face_names(const std::string &name);

// Does the name have %f in it?
bool names_faces(const std::string &name);

// "face_0.png .. face_5.png"
std::string name_list(const std::vector<std::string> &names);

#endif
