// SPDX-License-Identifier: MIT
//
// The command line of cubemap-orient.

#ifndef CUBEMAP_TOOLS_ORIENT_OPTIONS_HPP
#define CUBEMAP_TOOLS_ORIENT_OPTIONS_HPP

#include <optional>
#include <string>

#include <cubemap/orient.h>

#include "tools/cli/streams.h"

struct OrientOptions
{
    std::string mask;
    std::string mapping = CM_MAPPING_RECOMMENDED;
    cm_orient_measure measure = CM_ORIENT_DEFORMATION;
    cm_measure over = CM_OVER_SPHERE;
    std::optional<double> threshold;
    bool invert = false;
    double resolution = 0.1;
    int boxes = 0;                       // 0: as many as the library takes
    std::optional<std::string> evaluate; // an orientation, in place of the search
    std::string picture;
    std::string image;
    int size = 256; // of a face in the picture
    int threads = 0;
    bool json = false;
    bool quiet = false;
    bool list = false;
    bool printed = false; // is there nothing left to do?
};

// UsageFailure if they are wrong.
OrientOptions parse_orient_options(int argc, char **argv, const cm_streams &streams);

#endif
