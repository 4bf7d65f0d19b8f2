// SPDX-License-Identifier: MIT

#include "quantity.hpp"
#include "distortion_table.h"
#include "tools/cli/circle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace
{

constexpr double none = -std::numeric_limits<double>::infinity();

// Blue below the middle, red above; light where there is no distortion.
constexpr const char *diverging = "diverging-lightness";
constexpr const char *sequential = "sequential-custom";

} // namespace

const std::vector<Quantity> &quantities()
{
    using Arrays = cm_distortion_arrays;
    // clang-format off
    static const std::vector<Quantity> list = {
        {"area", "D_A", "", &Arrays::area, 1, 1, none, {0.25, 4}, diverging},
        {"isotropy", "D_I", "", &Arrays::isotropy, 1, 0, 1, {1, 2}, sequential},
        {"deformation", "omega", " degrees", &Arrays::deformation, 180 / pi, 0, 0, {0, 40}, sequential},
        {"scale", "s", "", &Arrays::scale, 1, 6 / pi, none, {1.5 / pi, 24 / pi}, diverging},
        {"texel-aspect", "L_x / L_y", "", &Arrays::texel_aspect, 1, 1, none, {0.5, 2}, diverging},
        {"texel-area", "L_x L_y", "", &Arrays::texel_area, 6 / pi, 1, none, {0.25, 4}, diverging}};
    // clang-format on
    return list;
}

const char *quantity_name_at(std::size_t index)
{
    return index < quantities().size() ? quantities()[index].name : nullptr;
}

Quantity with_mean_scale(const Quantity &quantity, double mean)
{
    Quantity changed = quantity;
    if (quantity.values == &cm_distortion_arrays::area)
    {
        changed.values = &cm_distortion_arrays::scale;
        changed.factor = 1 / mean;
    }
    else if (quantity.values == &cm_distortion_arrays::texel_area)
    {
        changed.factor = mean;
    }
    else if (quantity.values == &cm_distortion_arrays::scale)
    {
        const double part = mean / quantity.middle;
        changed.middle = mean;
        changed.range = {quantity.range.low * part, quantity.range.high * part};
    }
    return changed;
}

ColorScale::ColorScale(const Quantity &quantity, const ValueRange &value_range, bool turned_round)
    : colored(value_range), middle(quantity.middle), half(0),
      reversed(turned_round != !logarithmic())
{
    if (logarithmic())
    {
        half = std::max(std::fabs(std::log(colored.low / middle)),
                        std::fabs(std::log(colored.high / middle)));
    }
}

double ColorScale::place(double value) const
{
    const double inside = std::isnan(value) ? value : std::clamp(value, colored.low, colored.high);
    const double upwards = logarithmic() ? 0.5 + 0.5 * std::log(inside / middle) / half
                                         : (inside - colored.low) / (colored.high - colored.low);
    return reversed ? 1 - upwards : upwards;
}

double ColorScale::value_at(double part) const
{
    return logarithmic() ? colored.low * std::pow(colored.high / colored.low, part)
                         : colored.low + part * (colored.high - colored.low);
}

std::string ColorScale::description() const
{
    return logarithmic() ? "logarithmic about " + quantity_text(middle) : "linear";
}

std::string quantity_text(double value)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}
