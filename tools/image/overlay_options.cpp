// SPDX-License-Identifier: MIT

#include "overlay_options.hpp"

#include "cube_table.h"

#include <cmath>

namespace
{

double read_graticule(OptionReader &reader)
{
    const double degrees = reader.number();
    const double turns = 360 / degrees;
    // What does not divide the circle would leave a narrower gap somewhere.
    if (std::fabs(turns - std::round(turns)) > 1e-9 * turns)
    {
        reader.refuse("degrees that divide 360, such as 10, 15 or 22.5");
    }
    return 360 / std::round(turns);
}

Color read_color(OptionReader &reader)
{
    const std::string text = reader.text();
    const std::string digits = "0123456789abcdef";
    Color color = {};
    bool good = text.size() == 6;
    for (std::size_t i = 0; good && i < text.size(); ++i)
    {
        const char lower = text[i] >= 'A' && text[i] <= 'F' ? char(text[i] - 'A' + 'a') : text[i];
        const std::size_t digit = digits.find(lower);
        good = digit != std::string::npos;
        color[i / 2] += static_cast<float>(digit) * (i % 2 == 0 ? 16.0f : 1.0f) / 255.0f;
    }
    if (!good)
    {
        reader.refuse("a colour RRGGBB of six hexadecimal digits, such as ffcc00");
    }
    return color;
}

} // namespace

bool read_overlay_option(int id, OptionReader &reader, OverlayOptions &options)
{
    switch (id)
    {
    case OVERLAY_GRATICULE:
        options.graticule = read_graticule(reader);
        return true;
    case OVERLAY_GRID:
        options.grid = reader.whole_number();
        return true;
    case OVERLAY_INDICATRICES:
        options.indicatrices = reader.whole_number();
        return true;
    case OVERLAY_INDICATRICES_RADIUS:
        options.indicatrices_radius = reader.number();
        return true;
    case OVERLAY_LINE_WIDTH:
        options.line_width = reader.number();
        options.line_chosen = true;
        return true;
    case OVERLAY_LINE_COLOR:
        options.line_color = read_color(reader);
        options.line_chosen = true;
        return true;
    default:
        return false;
    }
}

void check_overlay_options(const OverlayOptions &options, bool other_lines)
{
    if (options.line_chosen && !options.wanted() && !other_lines)
    {
        throw UsageFailure("--line-width and --line-color are for lines, and there are none; say "
                           "--graticule, --grid or --indicatrices, too");
    }
    if (options.indicatrices_radius && !options.indicatrices)
    {
        throw UsageFailure("--indicatrices-radius is for ellipses; say --indicatrices N, too");
    }
}

OverlayOptions dark_lines()
{
    OverlayOptions options;
    options.line_width = 1;
    options.line_color = {0, 0, 0};
    return options;
}
