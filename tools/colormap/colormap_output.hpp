// SPDX-License-Identifier: MIT
//
// What cubemap-colormap writes: a map as text in several forms, and as a picture.

#ifndef CUBEMAP_TOOLS_COLORMAP_OUTPUT_HPP
#define CUBEMAP_TOOLS_COLORMAP_OUTPUT_HPP

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <cubemap/colormap.h>

struct ColormapDeleter
{
    void operator()(cm_colormap *map) const noexcept
    {
        cm_colormap_destroy(map);
    }
};

using ColormapPointer = std::unique_ptr<cm_colormap, ColormapDeleter>;

// One colour of a map, cut to sRGB.
struct Sample
{
    double t;
    std::array<double, 3> lch; // before it was cut
    std::array<double, 3> srgb;
    std::array<unsigned char, 3> bytes;
    bool inside;
};

// A map with the samples that are to be written, in the order in which they are.
struct SampledMap
{
    const cm_colormap *map;
    std::string name; // for programs that look maps up by name
    bool reversed;
    std::vector<Sample> samples;
    cm_colormap_clipping clipping;
};

SampledMap sample_map(const cm_colormap *map, const std::string &name, std::size_t count,
                      bool reversed);

// The map's specification with all parameters.
std::string specification_of(const cm_colormap *map);

// A number with so many significant digits, with a point in every locale.
std::string number_text(double value, int digits = 12);

std::string json_text(const SampledMap &sampled);
std::string csv_text(const SampledMap &sampled);
std::string matplotlib_text(const SampledMap &sampled);
std::string gimp_text(const SampledMap &sampled);

// The models with their parameters, for people.
std::string listing_text();

struct PictureSize
{
    int width = 512;
    int height = 64;
};

// A PNG file under that name, which appears when it is complete: bands of the samples from left to right, or
// Kovesi's test pattern.
void write_picture(const SampledMap &sampled, PictureSize size, bool test_pattern,
                   const std::string &path);

#endif
