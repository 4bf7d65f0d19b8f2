// SPDX-License-Identifier: MIT
//
// Tags of ours that stand in lines of a file's header.

#ifndef CUBEMAP_MODULES_IMAGE_HEADER_TAGS_HPP
#define CUBEMAP_MODULES_IMAGE_HEADER_TAGS_HPP

#include "header_lines.h"

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

using HeaderTags = std::vector<std::pair<std::string, std::string>>;

// Of the lines from text to before end.
inline HeaderTags header_tags(const char *text, const char *end)
{
    HeaderTags tags;
    cm_header_line line;
    while (cm_header_lines_next(&text, end, &line))
    {
        tags.emplace_back(std::string(line.key, line.key_size),
                          std::string(line.value, line.value_size));
    }
    return tags;
}

// Of a file of PNM, P1 to P6, in whose header comments stand between words. The file is left anywhere.
HeaderTags pnm_tags(std::FILE *file);

// Of a file of Radiance, whose header ends by a blank line. The file is left anywhere.
HeaderTags radiance_tags(std::FILE *file);

#endif
