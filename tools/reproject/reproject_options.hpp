// SPDX-License-Identifier: MIT
//
// The command line of cubemap-reproject.

#ifndef CUBEMAP_TOOLS_REPROJECT_OPTIONS_HPP
#define CUBEMAP_TOOLS_REPROJECT_OPTIONS_HPP

#include "tools/image/cube_options.hpp"
#include "tools/image/overlay_options.hpp"

#include <optional>
#include <string>

enum class Kind
{
    equirect,
    cube,
    chart // a mapping of one face
};

struct Options
{
    std::optional<Kind> from;
    std::optional<Kind> to;
    std::string from_mapping; // specifications that the library takes
    std::string to_mapping;
    std::optional<int> size;
    std::optional<CubeLayout> from_layout;
    std::optional<CubeLayout> layout;
    PolarColumns from_columns; // of crosses
    PolarColumns columns;
    const cm_frame *from_frame = nullptr;
    const cm_frame *frame = nullptr;
    Filter filter = Filter::bilinear;
    OverlayOptions overlay;
    int threads = 0;
    bool quiet = false;
    bool printed = false; // is there nothing left to do?
    std::string input;
    std::string output;
};

// UsageFailure if the command line is not one.
Options parse_options(int argc, char **argv, const cm_streams &streams);

#endif
