// SPDX-License-Identifier: MIT

#include "legend.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace
{

constexpr int margin = 36; // to both sides of the strip, for the half of a number
constexpr int strip_top = 6;
constexpr int strip_bottom = 30;
constexpr int tick_bottom = 36;
constexpr int text_top = 41;
constexpr int numbers = 5;

constexpr int glyph_width = 5;
constexpr int glyph_height = 7;
constexpr int glyph_step = 6;
constexpr int enlarged = 2;

struct Glyph
{
    char letter;
    const char *rows; // of 5, row by row
};

constexpr Glyph glyphs[] = {
    {'0', " ### #   ##  ### # ###  ##   # ### "}, {'1', "  #   ##    #    #    #    #   ### "},
    {'2', " ### #   #    #   #   #   #   #####"}, {'3', "#####   #   #     #     ##   # ### "},
    {'4', "   #   ##  # # #  # #####   #    # "}, {'5', "######    ####     #    ##   # ### "},
    {'6', "  ##  #   #    #### #   ##   # ### "}, {'7', "#####    #   #   #   #    #    #   "},
    {'8', " ### #   ##   # ### #   ##   # ### "}, {'9', " ### #   ##   # ####    #   #  ##  "},
    {'.', "                           ##   ## "}, {'-', "               #####               "},
    {'+', "       #    #  #####  #    #       "}, {'e', "           ### #   #######     ### "},
};

const char *glyph_rows(char letter)
{
    for (const Glyph &glyph : glyphs)
    {
        if (glyph.letter == letter)
        {
            return glyph.rows;
        }
    }
    return nullptr;
}

class Canvas
{
public:
    Canvas() : pixels(std::size_t{3} * legend_width * legend_height, 1.0f)
    {
    }

    void fill(int left, int top, int right, int bottom, const Color &color)
    {
        for (int y = top; y < bottom; ++y)
        {
            for (int x = std::max(left, 0); x < std::min(right, legend_width); ++x)
            {
                const std::size_t at =
                    std::size_t{3} * static_cast<std::size_t>(y * legend_width + x);
                std::copy(color.begin(), color.end(), pixels.begin() + static_cast<long>(at));
            }
        }
    }

    void write(int centre, int top, const std::string &text)
    {
        const int width = static_cast<int>(text.size()) * glyph_step - 1;
        int left = centre - width * enlarged / 2;
        for (const char letter : text)
        {
            const char *const rows = glyph_rows(letter);
            for (int i = 0; rows != nullptr && i < glyph_width * glyph_height; ++i)
            {
                const int x = left + i % glyph_width * enlarged;
                const int y = top + i / glyph_width * enlarged;
                if (rows[i] == '#')
                {
                    fill(x, y, x + enlarged, y + enlarged, {0, 0, 0});
                }
            }
            left += glyph_step * enlarged;
        }
    }

    std::vector<float> pixels;
};

std::string short_text(double value)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.3g", std::fabs(value) < 1e-12 ? 0.0 : value);
    return text;
}

} // namespace

std::vector<float> legend_pixels(const Colors &colors, const ColorScale &scale)
{
    constexpr int strip_width = legend_width - 2 * margin;
    constexpr Color black = {0, 0, 0};
    Canvas canvas;
    canvas.fill(margin - 1, strip_top - 1, margin + strip_width + 1, strip_bottom + 1, black);
    for (int x = 0; x < strip_width; ++x)
    {
        const double value = scale.value_at((x + 0.5) / strip_width);
        canvas.fill(margin + x, strip_top, margin + x + 1, strip_bottom,
                    colors.at(scale.place(value)));
    }
    for (int i = 0; i < numbers; ++i)
    {
        const double part = double(i) / (numbers - 1);
        const int x = margin + static_cast<int>(std::lround(part * strip_width));
        canvas.fill(x - 1, strip_bottom, x + 1, tick_bottom, black);
        canvas.write(x, text_top, short_text(scale.value_at(part)));
    }
    return canvas.pixels;
}
