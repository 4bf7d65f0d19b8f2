// SPDX-License-Identifier: MIT

#include "header_tags.hpp"

namespace
{

// What has no end by then is no header.
constexpr std::size_t header_most = std::size_t{1} << 20;

bool is_blank(int byte)
{
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

// The words of such a header: its kind, the width, the height, and of more than bits the greatest value. 0: there is none.
int pnm_words_of(int kind)
{
    return kind == '1' || kind == '4' ? 3 : kind >= '2' && kind <= '6' ? 4 : 0;
}

} // namespace

HeaderTags pnm_tags(std::FILE *file)
{
    std::string header;
    int words = 0;
    int wanted = 1;
    bool in_word = false;
    bool comment = false;
    while (words < wanted && header.size() < header_most)
    {
        const int byte = std::fgetc(file);
        if (byte == EOF)
        {
            return {};
        }
        header += static_cast<char>(byte);
        wanted = header.size() == 2 ? pnm_words_of(byte) : wanted;
        comment = comment ? byte != '\n' && byte != '\r' : byte == '#';
        const bool inside = !comment && !is_blank(byte);
        words += in_word && !inside ? 1 : 0;
        in_word = inside;
    }
    return header_tags(header.data(), header.data() + (words < wanted ? 0 : header.size()));
}

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
