// SPDX-License-Identifier: MIT
//
// The command line of cubemap-distortion.

#ifndef CUBEMAP_TOOLS_DISTORTION_OPTIONS_HPP
#define CUBEMAP_TOOLS_DISTORTION_OPTIONS_HPP

#include "tools/image/cube_options.hpp"
#include "tools/image/overlay_options.hpp"
#include "quantity.hpp"

#include <optional>
#include <string>

struct DistortionOptions
{
    std::string mapping;   // a specification that the library takes
    bool one_face = false; // has the mapping one?
    const cm_frame *frame = nullptr;
    const Quantity *quantity = nullptr;
    std::optional<CubeLayout> layout;
    std::optional<int> face; // this one alone
    int size = 256;
    std::string colors; // a specification that the library takes
    bool reverse = false;
    std::optional<ValueRange> range;
    std::optional<double> isolines;
    bool values = false;
    std::optional<std::string> legend;
    OverlayOptions overlay = dark_lines(); // as the colours are light where there is no distortion
    int threads = 0;
    bool quiet = false;
    bool printed = false; // is there nothing left to do?
    std::string output;
};

// UsageFailure if the command line is not one.
DistortionOptions parse_distortion_options(int argc, char **argv, const cm_streams &streams);

#endif
