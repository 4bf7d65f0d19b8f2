// SPDX-License-Identifier: MIT
//
// What becomes of resampled pixels before they are written to a format that means other values.

#ifndef CUBEMAP_TOOLS_COLOR_ROWS_HPP
#define CUBEMAP_TOOLS_COLOR_ROWS_HPP

#include <cstddef>

enum class Recode
{
    none,
    encode, // light to sRGB
    decode  // sRGB to light
};

struct ColorRows
{
    int channels = 0;
    int alpha = -1; // the channel, -1: none
    bool multiplied = false;
    bool multiply = false; // are colours to be multiplied by alpha afterwards?
    Recode recode = Recode::none;

    // count pixels. Colours are the first three channels beside alpha, or all of one or two; what is recoded is
    // divided by alpha, and multiplied again if multiply says so.
    void convert(float *pixels, std::size_t count) const;

    bool is_needed() const noexcept
    {
        return recode != Recode::none || multiply != multiplied;
    }
};

#endif
