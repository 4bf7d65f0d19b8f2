// SPDX-License-Identifier: MIT

#include "header_tags.hpp"

namespace
{

// What has no end by then is no header.
constexpr std::size_t header_most = std::size_t{1} << 20;

} // namespace

HeaderTags radiance_tags(std::FILE *file)
{
    std::string header;
    std::size_t end = std::string::npos;
    char block[4096];
    std::size_t taken = 1;
    while (end == std::string::npos && taken > 0 && header.size() < header_most)
    {
        const std::size_t from = header.empty() ? 0 : header.size() - 1;
        taken = std::fread(block, 1, sizeof block, file);
        header.append(block, taken);
        end = header.find("\n\n", from);
    }
    // a line that is cut says something else than the whole one
    header.resize((end == std::string::npos ? header.rfind('\n') : end) + 1);
    return header_tags(header.data(), header.data() + header.size());
}
