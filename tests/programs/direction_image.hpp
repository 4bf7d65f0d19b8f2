// SPDX-License-Identifier: MIT
//
// Test images that tell where they should be: each pixel of a direction image holds x, y and z of
// the direction of its centre. Makes them, and checks images that were resampled from one. Besides
// that, images of one colour, and what a file says of itself.
//
// The geometry here is written down independently of cubemap-reproject: point by point, with the
// crosses as tables.

#ifndef TESTS_DIRECTION_IMAGE_HPP
#define TESTS_DIRECTION_IMAGE_HPP

#include <string>
#include <vector>

struct Shape
{
    std::string specification; // "equirect", or a mapping
    std::string frame = "-";   // of a mapping of the cube
    std::string layout = "-";  // faces, strip, cross; of a mapping of the cube
};

inline const Shape equirect_shape = {"equirect", "-", "-"};

// size is the width of an equirectangular image, or of a face; %f in the name stands for the face.
void make_direction_image(const Shape &shape, int size, const std::string &name);

// std::runtime_error if an error is above largest or their mean above mean.
void check_direction_image(const Shape &shape, const std::string &name, double largest,
                           double mean);

// Metadata are NAME=VALUE; a whole number is stored as one.
void make_constant(int width, int height, int channels, const std::string &type, float value,
                   const std::string &name, const std::vector<std::string> &metadata = {});

// "64 x 32, 3 channels, uint8", and a line NAME=VALUE for each of its metadata.
std::string describe_image(const std::string &name);

// The mappings of the cube, or those of one face.
std::vector<std::string> catalogue_names(bool charts);

#endif
