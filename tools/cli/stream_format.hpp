// SPDX-License-Identifier: MIT
//
// Formats of pictures that go through pipes: those of Netpbm, and bare samples, which have the names that ffmpeg has for
// them (-pix_fmt).

#ifndef CUBEMAP_TOOLS_STREAM_FORMAT_HPP
#define CUBEMAP_TOOLS_STREAM_FORMAT_HPP

#include "image_description.hpp"

#include "modules/image/io/pnm_file.h"

#include <cstddef>
#include <string>

struct StreamFormat
{
    const char *name; // "ppm", "rgb24"
    cm_pnm_kind kind;
    int channels;       // 0: as many as there are, -1: one or three
    cm_pixel_type type; // of bare samples and PFM
    bool alpha;         // is the last channel alpha?
    bool planes;        // green, blue, red and alpha one plane after the other
};

// Where the samples of a picture's planes belong: green, blue, red and alpha.
constexpr std::size_t plane_channels[] = {1, 2, 0, 3};

// nullptr if there is none of that name.
const StreamFormat *find_stream_format(const std::string &name);

// The names apart by blanks; only those of bare samples, or only the others.
std::string stream_format_names(bool bare);

// The one that holds such a picture best: PGM, PPM or PFM, else PAM.
const StreamFormat &best_stream_format(const ImageDescription &source);

// How many of the channels it holds: all, or all but alpha; 0 if it cannot hold them.
int held_channels(const StreamFormat &format, const ImageDescription &source);

// The type that it has for one that is wanted.
cm_pixel_type held_type(const StreamFormat &format, cm_pixel_type wanted);

#endif
