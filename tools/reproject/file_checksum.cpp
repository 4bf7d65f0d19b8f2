// SPDX-License-Identifier: MIT

#include "file_checksum.hpp"
#include "tools/cli/program.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include <zlib.h>

std::uint32_t checksum_of(const void *bytes, std::size_t size)
{
    constexpr std::size_t most = std::size_t{1} << 30; // of a call
    const Bytef *from = static_cast<const Bytef *>(bytes);
    uLong sum = crc32(0, nullptr, 0);
    for (; size > 0;)
    {
        const std::size_t part = size < most ? size : most;
        sum = crc32(sum, from, static_cast<uInt>(part));
        from += part;
        size -= part;
    }
    return static_cast<std::uint32_t>(sum);
}

FileSum sum_of_file(const std::string &path, const std::string &name)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE *)> file(std::fopen(path.c_str(), "rb"),
                                                                std::fclose);
    FileSum result;
    uLong sum = crc32(0, nullptr, 0);
    std::vector<Bytef> part(std::size_t{1} << 20);
    std::size_t count = 0;
    while (file && (count = std::fread(part.data(), 1, part.size(), file.get())) > 0)
    {
        sum = crc32(sum, part.data(), static_cast<uInt>(count));
        result.bytes += count;
    }
    if (!file || std::ferror(file.get()) != 0)
    {
        throw Failure(in_quotes(name) + " cannot be read again: " + std::strerror(errno));
    }
    result.checksum = static_cast<std::uint32_t>(sum);
    return result;
}
