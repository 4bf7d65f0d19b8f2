// SPDX-License-Identifier: MIT

#include "legend.hpp"
#include "tools/image/lettering.hpp"

#include <cmath>
#include <cstdio>

namespace
{

constexpr int margin = 36; // to both sides of the strip, for the half of a number
constexpr int title_top = 6;
constexpr int strip_top = 28;
constexpr int strip_bottom = 52;
constexpr int tick_bottom = 58;
constexpr int text_top = 63;
constexpr int numbers = 5;
constexpr int dot = 2;

std::string short_text(double value)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.3g", std::fabs(value) < 1e-12 ? 0.0 : value);
    return text;
}

} // namespace

std::vector<float> legend_pixels(const Colors &colors, const ColorScale &scale,
                                 const std::string &title)
{
    constexpr int strip_width = legend_width - 2 * margin;
    constexpr Color black = {0, 0, 0};
    std::vector<float> pixels(std::size_t{3} * legend_width * legend_height, 1.0f);
    const Canvas canvas = {pixels.data(), legend_width, legend_height};
    write_text(canvas, margin, title_top, title, dot);
    fill_box(canvas, margin - 1, strip_top - 1, margin + strip_width + 1, strip_bottom + 1, black);
    for (int x = 0; x < strip_width; ++x)
    {
        const double value = scale.value_at((x + 0.5) / strip_width);
        fill_box(canvas, margin + x, strip_top, margin + x + 1, strip_bottom,
                 colors.at(scale.place(value)));
    }
    for (int i = 0; i < numbers; ++i)
    {
        const double part = double(i) / (numbers - 1);
        const int x = margin + static_cast<int>(std::lround(part * strip_width));
        const std::string number = short_text(scale.value_at(part));
        fill_box(canvas, x - 1, strip_bottom, x + 1, tick_bottom, black);
        write_text(canvas, x - text_width(number, dot) / 2, text_top, number, dot);
    }
    return pixels;
}
