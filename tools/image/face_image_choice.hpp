// SPDX-License-Identifier: MIT
//
// Which kind of image a mapping has.

#ifndef CUBEMAP_TOOLS_FACE_IMAGE_CHOICE_HPP
#define CUBEMAP_TOOLS_FACE_IMAGE_CHOICE_HPP

#include "face_image.hpp"

// A cube or a chart, as the specification says; the frame is that of a cube.
std::unique_ptr<FaceImage> make_face_image(const std::string &specification, const cm_frame &frame,
                                           int size);

#endif
