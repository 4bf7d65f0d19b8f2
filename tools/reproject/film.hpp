// SPDX-License-Identifier: MIT
//
// Many pictures by one command line: files with numbers in their names, and pictures that come through a pipe.

#ifndef CUBEMAP_TOOLS_REPROJECT_FILM_HPP
#define CUBEMAP_TOOLS_REPROJECT_FILM_HPP

#include "reproject_options.hpp"

// Is INPUT, or OUTPUT, more than files of one picture? UsageFailure if they do not go together.
bool is_film(const Options &options);

// Reads, computes and writes them one after another; those before one that fails stay. The exit status.
int reproject_film(const Options &options, int threads, const cm_streams &streams);

#endif
