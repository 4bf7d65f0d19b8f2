// SPDX-License-Identifier: MIT

#include "lettering.hpp"

#include <algorithm>
#include <cstddef>

namespace
{

constexpr int glyph_width = 5;
constexpr int glyph_height = 7;
constexpr int glyph_step = 6;

struct Glyph
{
    char letter;
    const char *rows; // of 5, row by row
};

// clang-format off
constexpr Glyph glyphs[] = {
    {'(', "   #   #   #    #    #     #     # "}, {')', " #     #     #    #    #   #   #   "},
    {'+', "       #    #  #####  #    #       "}, {',', "                      #    #   #   "},
    {'-', "               #####               "}, {'.', "                           ##   ## "},
    {'/', "    #    #   #   #   #   #    #    "}, {'0', " ### #   ##  ### # ###  ##   # ### "},
    {'1', "  #   ##    #    #    #    #   ### "}, {'2', " ### #   #    #   #   #   #   #####"},
    {'3', "#####   #   #     #     ##   # ### "}, {'4', "   #   ##  # # #  # #####   #    # "},
    {'5', "######    ####     #    ##   # ### "}, {'6', "  ##  #   #    #### #   ##   # ### "},
    {'7', "#####    #   #   #   #    #    #   "}, {'8', " ### #   ##   # ### #   ##   # ### "},
    {'9', " ### #   ##   # ####    #   #  ##  "}, {':', "       #    #         #    #       "},
    {';', "       #    #         #    #   #   "}, {'=', "          #####     #####          "},
    {'>', " #     #     #     #   #   #   #   "}, {'A', " ### #   ##   #######   ##   ##   #"},
    {'D', "#### #   ##   ##   ##   ##   ##### "}, {'I', " ###   #    #    #    #    #   ### "},
    {'L', "#    #    #    #    #    #    #####"}, {'_', "                              #####"},
    {'a', "           ###     # #####   # ####"}, {'b', "#    #    #### #   ##   ##   ##### "},
    {'c', "           #####    #    #     ####"}, {'d', "    #    # #####   ##   ##   # ####"},
    {'e', "           ### #   #######     ####"}, {'f', "  ##  #  # #   ####  #    #    #   "},
    {'g', "           #####   # ####    # ### "}, {'h', "#    #    #### #   ##   ##   ##   #"},
    {'i', "  #        ##    #    #    #   ### "}, {'j', "   #        ##    #    # #  #  ##  "},
    {'k', "#    #    #  # # #  ##   # #  #  # "}, {'l', " ##    #    #    #    #    #   ### "},
    {'m', "          ## # # # ## # ## # ## # #"}, {'n', "          #### #   ##   ##   ##   #"},
    {'o', "           ### #   ##   ##   # ### "}, {'p', "          #### #   ##### #    #    "},
    {'q', "           #####   # ####    #    #"}, {'r', "          # ## ##  ##    #    #    "},
    {'s', "           #####     ###     ##### "}, {'t', " #    #   ####  #    #    #  #  ## "},
    {'u', "          #   ##   ##   ##  ## ## #"}, {'v', "          #   ##   ##   # # #   #  "},
    {'w', "          #   ## # ## # ## # # # # "}, {'x', "          #   # # #   #   # # #   #"},
    {'y', "          #   ##   # ####    # ### "}, {'z', "          #####   #   #   #   #####"},
    {'|', "  #    #    #    #    #    #    #  "},
};
// clang-format on

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

} // namespace

void fill_box(const Canvas &canvas, int left, int top, int right, int bottom,
              const std::array<float, 3> &color)
{
    for (int y = std::max(top, 0); y < std::min(bottom, canvas.height); ++y)
    {
        for (int x = std::max(left, 0); x < std::min(right, canvas.width); ++x)
        {
            const auto at = static_cast<std::ptrdiff_t>(y) * canvas.width + x;
            std::copy(color.begin(), color.end(), canvas.pixels + 3 * at);
        }
    }
}

int text_width(const std::string &text, int dot)
{
    return (static_cast<int>(text.size()) * glyph_step - 1) * dot;
}

int text_height(int dot)
{
    return glyph_height * dot;
}

void write_text(const Canvas &canvas, int left, int top, const std::string &text, int dot)
{
    for (const char letter : text)
    {
        const char *const rows = glyph_rows(letter);
        for (int i = 0; rows != nullptr && i < glyph_width * glyph_height; ++i)
        {
            const int x = left + i % glyph_width * dot;
            const int y = top + i / glyph_width * dot;
            if (rows[i] == '#')
            {
                fill_box(canvas, x, y, x + dot, y + dot, {0, 0, 0});
            }
        }
        left += glyph_step * dot;
    }
}
