// SPDX-License-Identifier: MIT
//
// The legend of a picture of distortion: a strip of its colours, with numbers. The digits are drawn
// here, as a system may have no font that the image library finds.

#ifndef CUBEMAP_TOOLS_LEGEND_HPP
#define CUBEMAP_TOOLS_LEGEND_HPP

#include "colors.hpp"
#include "quantity.hpp"

inline constexpr int legend_width = 520;
inline constexpr int legend_height = 62;

// Red, green and blue of its pixels, row by row.
std::vector<float> legend_pixels(const Colors &colors, const ColorScale &scale);

#endif
