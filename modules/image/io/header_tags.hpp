// SPDX-License-Identifier: MIT
//
// Tags of ours that stand in lines of a file's header.

#ifndef CUBEMAP_MODULES_IMAGE_HEADER_TAGS_HPP
#define CUBEMAP_MODULES_IMAGE_HEADER_TAGS_HPP

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

using HeaderTags = std::vector<std::pair<std::string, std::string>>;

// Of the first so many bytes of a file, or of fewer if the file or its header, which a blank line ends, is shorter. The
// file is left anywhere.
HeaderTags header_tags(std::FILE *file, std::size_t bytes);

#endif
