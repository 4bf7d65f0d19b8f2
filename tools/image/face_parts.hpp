// SPDX-License-Identifier: MIT
//
// OpenEXR files whose parts are the six faces of a cube, each with the name of its face.

#ifndef CUBEMAP_TOOLS_FACE_PARTS_HPP
#define CUBEMAP_TOOLS_FACE_PARTS_HPP

#include "tools/cli/image_file.hpp"

#include <string>
#include <vector>

// Whose faces the names of a file's parts are.
enum class PartOrder
{
    file, // nobody's: they are as they stand in the file
    geo,  // front, right, back, left, top and bottom
    gl    // +x, px or posx, and so on
};

// Six pictures of one file, as opened, into the order of the frame whose names they have.
PartOrder order_parts(std::vector<ImageFile> &parts);

// Are they six squares of one size?
bool are_faces(const std::vector<ImageFile> &parts);

#endif
