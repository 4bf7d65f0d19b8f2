// SPDX-License-Identifier: MIT
//
// Colours for numbers: a colour map of the library cubemap-colormap as a table.

#ifndef CUBEMAP_TOOLS_COLORS_HPP
#define CUBEMAP_TOOLS_COLORS_HPP

#include "tools/image/overlay_options.hpp"

#include <string>
#include <vector>

class Colors
{
public:
    // The specification must be one that the library takes.
    explicit Colors(const std::string &specification);

    // The colour at a place from 0 to 1; the end's colour beyond them, and grey for NaN.
    Color at(double place) const;

    // How many of the table's colours are outside sRGB, and so cut to it, and of how many.
    std::size_t cut() const noexcept
    {
        return outside;
    }
    std::size_t count() const noexcept
    {
        return table.size();
    }

private:
    std::vector<Color> table;
    std::size_t outside = 0;
};

// UsageFailure, which names the option, if the library does not take the specification.
void check_colors(const std::string &option, const std::string &specification);

#endif
