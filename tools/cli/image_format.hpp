// SPDX-License-Identifier: MIT
//
// What the formats of image files can hold of an image that was read from another.

#ifndef CUBEMAP_TOOLS_IMAGE_FORMAT_HPP
#define CUBEMAP_TOOLS_IMAGE_FORMAT_HPP

#include "image_description.hpp"

#include <string>
#include <vector>

// What an output file is to hold.
struct ImagePlan
{
    std::string format; // "png", "jpeg", "tiff", "openexr" or "hdr", or a name of stream_format.hpp
    ImageDescription description; // of the output
    bool alpha_dropped;           // the format has none
    bool multiply_alpha; // the format wants colours multiplied by alpha, and they are not yet
    std::vector<std::string> parts = {}; // the names of the file's pictures; none: it is one
};

// The file format that a name's extension stands for, UsageFailure if it is none that we write.
std::string output_format(const std::string &path);

// The type of pixels that a file of that format has for one that the description asks for.
cm_pixel_type held_type(const std::string &format, cm_pixel_type wanted);

// What a file of that format holds of an image that was read from a file with this description.
// "pnm" is the one of Netpbm's formats that holds it best. Failure if the format cannot hold so many channels.
ImagePlan plan_image(const std::string &format, const ImageDescription &source,
                     const std::string &source_format, const std::string &path);

// How its files are compressed, by a name or number that the format has. UsageFailure if it is none.
void set_compression(ImagePlan &plan, const std::string &compression);

#endif
