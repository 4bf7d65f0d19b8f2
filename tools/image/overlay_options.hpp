// SPDX-License-Identifier: MIT
//
// The options of what is drawn over pictures of the sphere.

#ifndef CUBEMAP_TOOLS_OVERLAY_OPTIONS_HPP
#define CUBEMAP_TOOLS_OVERLAY_OPTIONS_HPP

#include "tools/cli/program.hpp"

#include <array>
#include <optional>

// Red, green and blue, 0 to 1, as the image stores them.
using Color = std::array<float, 3>;

struct OverlayOptions
{
    std::optional<double> graticule;           // degrees between the lines
    std::optional<int> grid;                   // cells along the edge of a face
    std::optional<int> indicatrices;           // ellipses along the edge of a face
    std::optional<double> indicatrices_radius; // degrees
    double line_width = 1.5;                   // pixels
    Color line_color = {1, 1, 1};
    bool line_chosen = false; // did the user say how lines are to look?

    bool wanted() const noexcept
    {
        return graticule || grid || indicatrices;
    }
};

// Thin and black, for light pictures.
OverlayOptions dark_lines();

// Takes the reader's option if it is one of these; else false. UsageFailure if its value is wrong.
bool read_overlay_option(int id, OptionReader &reader, OverlayOptions &options);

// UsageFailure if there are options that do nothing without others. Has the picture lines besides
// these?
void check_overlay_options(const OverlayOptions &options, bool other_lines);

#endif
