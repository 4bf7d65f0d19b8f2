// SPDX-License-Identifier: MIT
//
// CRC-32 as zlib, PNG and Ethernet have it: finds what was damaged, not what somebody has changed on purpose.

#ifndef CUBEMAP_TOOLS_FILE_CHECKSUM_HPP
#define CUBEMAP_TOOLS_FILE_CHECKSUM_HPP

#include <cstddef>
#include <cstdint>
#include <string>

std::uint32_t checksum_of(const void *bytes, std::size_t size);

// What a file is.
struct FileSum
{
    std::uint64_t bytes = 0;
    std::uint32_t checksum = 0;
};

// Failure if it cannot be read; name is what the user calls it.
FileSum sum_of_file(const std::string &path, const std::string &name);

#endif
