// SPDX-License-Identifier: MIT
//
// Pictures of views in files: depth and colours of the camera's size, and 16-bit PNG.

#ifndef CUBEMAP_MODULES_SCENE_PICTURE_FILE_HPP
#define CUBEMAP_MODULES_SCENE_PICTURE_FILE_HPP

#include "view_check.hpp"

#include <string>

// One channel of 16 bits, or of floating point (EXR, NPY, TIFF, PFM): CM_PIXEL_U16 or CM_PIXEL_FLOAT. FileFailure.
void read_depth(const std::string &path, const cm_camera_options &camera, OwnPicture &picture);
// Any channels; numbers of 8 or 16 bits stay so, all others become float.
void read_color(const std::string &path, const cm_camera_options &camera, OwnPicture &picture);

// PNG. Whole numbers keep their size; floating point from 0 to 1 becomes 8 bits, rounded to the nearest.
void write_picture(const std::string &path, const cm_image &image);

#endif
