// SPDX-License-Identifier: MIT

#include "overlay_options.hpp"

#include <cmath>
#include <cstdio>

namespace
{

constexpr int most_cells = 1024;
constexpr int most_indicatrices = 256;
constexpr double widest_line = 100;

double read_graticule(ArgumentReader &reader)
{
    const std::string option = reader.text();
    const double degrees = reader.not_negative_number();
    const double turns = 360 / degrees;
    // What does not divide the circle would leave a narrower gap somewhere.
    if (!(degrees >= 0.01 && degrees <= 180) || std::fabs(turns - std::round(turns)) > 1e-9 * turns)
    {
        throw UsageFailure(option + ": the degrees must be from 0.01 to 180 and divide 360, such "
                                    "as 10, 15 or 22.5");
    }
    return 360 / std::round(turns);
}

double read_between(ArgumentReader &reader, double low, double high)
{
    const std::string option = reader.text();
    const std::string text = reader.value();
    const std::optional<double> number = read_number(text);
    if (!number || *number < low || *number > high)
    {
        char range[80];
        std::snprintf(range, sizeof range, " is not a number from %g to %g", low, high);
        throw UsageFailure(option + ": " + in_quotes(text) + range);
    }
    return *number;
}

Color read_color(ArgumentReader &reader)
{
    const std::string option = reader.text();
    const std::string text = reader.value();
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
        throw UsageFailure(option + ": " + in_quotes(text) +
                           " is not a colour RRGGBB of six hexadecimal digits, such as ffcc00");
    }
    return color;
}

} // namespace

const std::map<std::string, OverlayOptionAction> &overlay_option_actions()
{
    static const std::map<std::string, OverlayOptionAction> actions = {
        {"--graticule", [](ArgumentReader &reader, OverlayOptions &options)
         { options.graticule = read_graticule(reader); }},
        {"--grid", [](ArgumentReader &reader, OverlayOptions &options)
         { options.grid = static_cast<int>(reader.whole_number(1, most_cells)); }},
        {"--indicatrices", [](ArgumentReader &reader, OverlayOptions &options)
         { options.indicatrices = static_cast<int>(reader.whole_number(1, most_indicatrices)); }},
        {"--indicatrices-radius", [](ArgumentReader &reader, OverlayOptions &options)
         { options.indicatrices_radius = read_between(reader, 1e-6, 45); }},
        {"--line-width",
         [](ArgumentReader &reader, OverlayOptions &options)
         {
             options.line_width = read_between(reader, 0.1, widest_line);
             options.line_chosen = true;
         }},
        {"--line-color", [](ArgumentReader &reader, OverlayOptions &options)
         {
             options.line_color = read_color(reader);
             options.line_chosen = true;
         }}};
    return actions;
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

std::string overlay_help_text(const OverlayOptions &standard)
{
    char width[20];
    std::snprintf(width, sizeof width, "%g", standard.line_width);
    return R"(  --graticule DEGREES   meridians and parallels, so many degrees apart; DEGREES
                        divides 360. Towards the poles there are fewer meridians
  --grid N              the lines of u and v that divide each face into N x N cells
  --indicatrices N      Tissot's ellipses at the centres of N x N cells of each face,
                        as large as they can be without overlap
  --indicatrices-radius DEGREES
                        the radius of their circles on the sphere, to compare
  --line-width PIXELS   0.1 to 100; without it, )" +
           std::string(width) + R"(; a thin casing is beside it
  --line-color RRGGBB   hexadecimal; without it, )" +
           (standard.line_color[0] > 0 ? "ffffff" : "000000") + "\n";
}
