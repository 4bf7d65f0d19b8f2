// SPDX-License-Identifier: MIT
//
// Pictures of floats that programs have in memory, into files.

#ifndef CUBEMAP_TOOLS_FLOAT_PICTURE_HPP
#define CUBEMAP_TOOLS_FLOAT_PICTURE_HPP

#include "atomic_file.hpp"

#include <memory>
#include <string>
#include <vector>

// Rows of floats, whose channels lie side by side, into a file of the format that its name ends with. names: of the
// channels; none: the usual ones. The file is complete, and appears later, with others.
std::unique_ptr<AtomicFile> write_float_picture(const std::string &path, const float *rows,
                                                int width, int height, int channels,
                                                const std::vector<std::string> &names, int threads);

#endif
