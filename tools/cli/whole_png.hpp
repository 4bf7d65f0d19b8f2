// SPDX-License-Identifier: MIT
//
// Is a PNG file whole? libpng reports a file that ends too early on stderr, or, when only the end
// is missing, not at all.

#ifndef CUBEMAP_TOOLS_WHOLE_PNG_HPP
#define CUBEMAP_TOOLS_WHOLE_PNG_HPP

#include <string>

// Failure if the file begins like a PNG file and does not have all of its chunks. Other files, and
// files that cannot be read, pass.
void check_whole_png(const std::string &path);

#endif
