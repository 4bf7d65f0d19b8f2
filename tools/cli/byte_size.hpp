// SPDX-License-Identifier: MIT
//
// Sizes of memory as people write them: 512M, 2G.

#ifndef CUBEMAP_TOOLS_BYTE_SIZE_HPP
#define CUBEMAP_TOOLS_BYTE_SIZE_HPP

#include <cstdint>
#include <optional>
#include <string>

// Bytes: a number and K, M, G or T of 1024 each, with B or iB behind it or not; a number alone is M. Nothing if it is not that
// or beyond 1e18.
std::optional<std::uint64_t> read_byte_size(const std::string &text);

#endif
