// SPDX-License-Identifier: MIT
//
// The command line of cubemap-reproject.

#ifndef CUBEMAP_TOOLS_REPROJECT_OPTIONS_HPP
#define CUBEMAP_TOOLS_REPROJECT_OPTIONS_HPP

#include "tools/image/overlay_options.hpp"
#include "tools/image/surface_options.hpp"

#include "tools/cli/picture_stream.hpp"

#include <cubemap/image.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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
    std::string from_file; // that says what INPUT is; "": --from is not one
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
    bool parts = false;        // of one OpenEXR file, which the six faces are
    std::string healpix_order; // "nest", "ring", or not said
    int border = 0;
    std::optional<int> order; // of HiPS tiles
    int tile_width = 0;       // of those; 0: not said
    std::string tiles;        // "jpeg", "png", "fits", or not said
    std::string creator_did;  // who publishes them; "": not said
    bool georeference = false;
    std::optional<int> start; // of a film: the number of its first picture
    std::optional<int> count;
    std::optional<BarePictures> raw; // what comes through a pipe, if it does not say so itself
    std::string pipe; // the format of what goes into one; "": the one that holds it best
    OverlayOptions overlay;
    int threads = 0;
    std::uint64_t memory = 0; // bytes; 0: no ceiling
    bool resume = false;
    std::string manifest;           // the file's name; "": none
    std::vector<std::string> words; // "--NAME=TEXT" of all options that may change the output
    bool quiet = false;
    bool printed = false; // is there nothing left to do?
    std::string input;
    std::string output;
    std::FILE *output_stream = nullptr; // where OUTPUT goes if it is a pipe
};

// Is this INPUT or OUTPUT a pipe?
inline bool is_pipe(const std::string &name)
{
    return name == "-";
}

// UsageFailure if the command line is not one.
Options parse_options(int argc, char **argv, const cm_streams &streams);

#endif
