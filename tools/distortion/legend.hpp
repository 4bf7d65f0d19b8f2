// SPDX-License-Identifier: MIT
//
// The legend of a picture of distortion: what is shown and its unit, a strip of its colours, and numbers.

#ifndef CUBEMAP_TOOLS_LEGEND_HPP
#define CUBEMAP_TOOLS_LEGEND_HPP

#include "colors.hpp"
#include "quantity.hpp"

inline constexpr int legend_width = 520;
inline constexpr int legend_height = 84;

// Red, green and blue of its pixels, row by row.
std::vector<float> legend_pixels(const Colors &colors, const ColorScale &scale,
                                 const std::string &title);

#endif
