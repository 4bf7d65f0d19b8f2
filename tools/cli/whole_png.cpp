// SPDX-License-Identifier: MIT

#include "whole_png.hpp"
#include "program.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>

namespace
{

constexpr char png_signature[] = "\x89PNG\r\n\x1a\n";

} // namespace

void check_whole_png(const std::string &path)
{
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::int64_t size = file.tellg();
    char signature[8];
    if (!file.seekg(0).read(signature, 8) || std::memcmp(signature, png_signature, 8) != 0)
    {
        return;
    }
    // A chunk is its length, its name, its content and a check sum.
    for (std::int64_t position = 8; position + 12 <= size;)
    {
        unsigned char head[8];
        if (!file.seekg(position).read(reinterpret_cast<char *>(head), 8))
        {
            break;
        }
        const std::int64_t length =
            std::int64_t{head[0]} << 24 | head[1] << 16 | head[2] << 8 | head[3];
        position += 12 + length;
        if (std::memcmp(head + 4, "IEND", 4) == 0 && position <= size)
        {
            return;
        }
    }
    throw Failure(in_quotes(path) + " is damaged or ends too early: a PNG file without its end");
}
