// SPDX-License-Identifier: MIT
//
// Files that are written besides the pictures.

#ifndef CUBEMAP_TOOLS_REPROJECT_OTHER_FILES_HPP
#define CUBEMAP_TOOLS_REPROJECT_OTHER_FILES_HPP

#include "reproject_input.hpp"
#include "reproject_options.hpp"

#include <string>
#include <vector>

// names: OUTPUT's files. UsageFailure if a sidecar or a manifest would take the place of a file that is read, or of
// another one that is written.
void check_other_files(const Options &options, const Input &input,
                       const std::vector<std::string> &names);

#endif
