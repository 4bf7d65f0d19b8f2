// SPDX-License-Identifier: MIT
//
// One pixel in place of many.

#ifndef CUBEMAP_TOOLS_PIXEL_MEAN_HPP
#define CUBEMAP_TOOLS_PIXEL_MEAN_HPP

#include <cubemap/image.h>

#include <cstdint>

// The mean of width x width pixels of a picture, of bytes or floats, from (column, row). Colours weigh as much as the
// channel alpha; -1: there is none.
void put_mean(const cm_image &from, std::uint32_t column, std::uint32_t row, std::uint32_t width,
              int alpha, unsigned char *to);

#endif
