// SPDX-License-Identifier: MIT
//
// The picture of cubemap-orient: the faces of a cube before and after it is turned.

#ifndef CUBEMAP_TOOLS_ORIENT_PICTURE_HPP
#define CUBEMAP_TOOLS_ORIENT_PICTURE_HPP

#include "orient_options.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

// An equirectangular image in memory.
struct WholeImage
{
    int width = 0;
    int height = 0;
    int channels = 0; // one beside the other
    std::vector<float> pixels;
};

// Failure if it cannot be read or is not twice as wide as high; with gray its channels are made one, the luminance,
// and else three.
WholeImage read_equirect(const std::string &path, bool gray);

class OrientPicture
{
public:
    // Opens the output, and the image that is to be shown if there is one. mask must outlive it.
    OrientPicture(const OrientOptions &options, const WholeImage &mask);
    ~OrientPicture();

    // Above the cube as it is, below as it is turned, each with its title in lines of up to 26 letters; a scale of
    // lengths, and one of colours if the picture is not of an image. Faces of fewer than 80 pixels have no room for
    // words.
    void write(const cm_rotation &after, const std::array<std::vector<std::string>, 2> &titles,
               int threads);

private:
    struct Parts;
    std::unique_ptr<Parts> parts;
};

#endif
