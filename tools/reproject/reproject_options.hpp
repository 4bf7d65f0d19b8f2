// SPDX-License-Identifier: MIT
//
// The command line of cubemap-reproject.

#ifndef CUBEMAP_TOOLS_REPROJECT_OPTIONS_HPP
#define CUBEMAP_TOOLS_REPROJECT_OPTIONS_HPP

#include "tools/image/overlay_options.hpp"

#include <cubemap/image.h>

#include <optional>
#include <string>

// What the command line says of INPUT's surface, or of OUTPUT's; what it does not say is empty.
struct SurfaceOptions
{
    std::string specification; // one that the library takes, if sizes are left aside
    std::string frame;
    std::string layout;
    std::optional<cm_rotation> rotation;
};

enum class Keep
{
    equator, // the resolution at the equator, and of what is no equirectangular image and no cube in the mean
    mean, // the number of pixels
    most  // the greatest density
};

enum class NotFinite
{
    skip,
    zero,
    spread,
    refuse
};

struct Options
{
    SurfaceOptions from;
    SurfaceOptions to;
    const cm_surface_preset *preset = nullptr; // of OUTPUT
    std::string mapping;                       // --mapping, "" if it is not said
    std::string mapping_reason;                // for people, if that is auto
    bool texture = false;                      // is OUTPUT a cube in a texture?
    std::optional<int> size;
    Keep keep = Keep::equator;
    cm_filter filter = CM_FILTER_AUTO;
    cm_transfer transfer = CM_TRANSFER_STORED;
    double gamma = 0;
    bool stored = false;
    int vector = 0; // the first channel, counted from 1; 0: there is none
    std::optional<NotFinite> not_finite;
    bool dither = false;
    std::optional<double> tolerance;
    std::string compression;
    bool sidecar = false;
    bool mips = false;
    std::string healpix_order; // "nest", "ring", or not said
    int border = 0;
    std::optional<int> order; // of HiPS tiles
    int tile_width = 0;       // of those; 0: not said
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
