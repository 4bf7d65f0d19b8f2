// SPDX-License-Identifier: MIT
//
// Words and numbers in pictures. The letters are drawn here, as a system may have no font that the image
// library finds: a-z, digits, signs, and the capitals of symbols. What is no such letter is a blank.

#ifndef CUBEMAP_TOOLS_LETTERING_HPP
#define CUBEMAP_TOOLS_LETTERING_HPP

#include <array>
#include <string>

// Red, green and blue of a picture, row by row.
struct Canvas
{
    float *pixels;
    int width;
    int height;
};

// The pixels from left to right - 1 and top to bottom - 1, as far as they are in the picture.
void fill_box(const Canvas &canvas, int left, int top, int right, int bottom,
              const std::array<float, 3> &color);

// How many pixels a text is wide and high; a letter's dots are squares of so many pixels.
int text_width(const std::string &text, int dot);
int text_height(int dot);

// In black, with its upper left corner there.
void write_text(const Canvas &canvas, int left, int top, const std::string &text, int dot);

#endif
