// SPDX-License-Identifier: MIT

#include "colors.hpp"
#include "tools/cli/colormap_name.h"

#include <cubemap/colormap.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace
{

// Odd, so that the middle of a diverging map is one of them; between them colours are mixed.
constexpr std::size_t table_size = 4097;

constexpr Color no_number = {0.5f, 0.5f, 0.5f};

struct MapDeleter
{
    void operator()(cm_colormap *map) const noexcept
    {
        cm_colormap_destroy(map);
    }
};

} // namespace

Colors::Colors(const std::string &specification) : table(table_size)
{
    cm_colormap *made = nullptr;
    const cm_status status = cm_colormap_create(specification.c_str(), &made);
    const std::unique_ptr<cm_colormap, MapDeleter> map(made);
    if (status != CM_OK)
    {
        throw Failure(in_quotes(specification) + ": " + cm_status_text(status));
    }
    std::vector<double> channels(3 * table_size);
    cm_colormap_clipping clipping = {};
    cm_colormap_samples(map.get(), table_size, channels.data(), &clipping);
    outside = clipping.count;
    for (std::size_t i = 0; i < channels.size(); ++i)
    {
        table[i / 3][i % 3] = static_cast<float>(channels[i]);
    }
}

Color Colors::at(double place) const
{
    if (std::isnan(place))
    {
        return no_number;
    }
    const double last = static_cast<double>(table_size - 1);
    const double position = std::clamp(place, 0.0, 1.0) * last;
    const std::size_t before = std::min(static_cast<std::size_t>(position), table_size - 2);
    const float part = static_cast<float>(position - static_cast<double>(before));
    Color color = {};
    for (std::size_t c = 0; c < 3; ++c)
    {
        color[c] = (1 - part) * table[before][c] + part * table[before + 1][c];
    }
    return color;
}

void check_colors(const std::string &option, const std::string &specification)
{
    char message[400];
    if (cm_colormap_check(specification.c_str(), message, sizeof message) != CM_OK)
    {
        throw UsageFailure(option + ": " + in_quotes(specification) + ": " + message +
                           suggestion(nearest_colormap(specification.c_str())));
    }
}
