// SPDX-License-Identifier: MIT
//
// The two images as pictures that lie on each other, pixel by pixel, and what each pixel weighs; and the picture of the
// difference. Image files are used nowhere else in this program.

#ifndef CUBEMAP_TOOLS_COMPARE_PICTURES_HPP
#define CUBEMAP_TOOLS_COMPARE_PICTURES_HPP

#include <cubemap/image.h>

#include <memory>
#include <string>
#include <vector>

struct Pictures
{
    std::string reference_name;
    std::string picture_name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t channels = 0;
    std::vector<std::string> channel_names;
    bool integers = false; // do both hold integers, 0 to 1 here?
    std::vector<float> reference;
    std::vector<float> picture;
    // solid angles of a row's pixels, or of all pixels; empty if it is not known where on the sphere they are
    std::vector<float> areas;
    // 1 for pixels that count, 0 for those that one of the images does not show; empty: all count
    std::vector<float> shown;
    // of the reference, and so of both; nullptr if pixels are compared as they stand
    std::shared_ptr<const cm_surface> surface;
    std::vector<std::string> warnings; // lines for people
};

// How the sphere lies on the images: specifications of surfaces, "" for what is not said.
struct Surfaces
{
    std::string reference;
    std::string picture;
};

// With a surface, or if the images differ in size and files say what they are, the second image is resampled onto the first
// one's. A name with %f is of six faces. UsageFailure if a surface is none, or is not of one image; Failure if an image cannot be read, or if they are not alike.
Pictures read_pictures(const std::string &reference, const std::string &picture,
                       const Surfaces &surfaces, unsigned threads);

// The vectors as the library has them.
cm_image image_of(std::vector<float> &values, std::uint32_t width, std::uint32_t height,
                  std::uint32_t channels);

// UsageFailure if that is no name for a picture of the difference, or that of an image which is read.
void check_difference_name(const std::string &name, const std::vector<std::string> &others);

// Three floats of sRGB a pixel, 0 to 1, into a file that appears when it is complete.
void write_difference(const std::string &name, std::uint32_t width, std::uint32_t height,
                      const std::vector<float> &colors);

#endif
