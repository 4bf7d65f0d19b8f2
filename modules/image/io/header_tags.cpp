// SPDX-License-Identifier: MIT

#include "header_tags.hpp"
#include "header_lines.h"

#include <algorithm>

HeaderTags header_tags(std::FILE *file, std::size_t bytes)
{
    std::string header(bytes, '\0');
    HeaderTags tags;
    if (std::fseek(file, 0, SEEK_SET) != 0)
    {
        return tags;
    }
    header.resize(std::fread(header.data(), 1, bytes, file));
    header.resize(std::min(header.find("\n\n"), header.size()));
    const char *at = header.data();
    cm_header_line line;
    while (cm_header_lines_next(&at, header.data() + header.size(), &line))
    {
        tags.emplace_back(std::string(line.key, line.key_size),
                          std::string(line.value, line.value_size));
    }
    return tags;
}
