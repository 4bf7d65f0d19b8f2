// SPDX-License-Identifier: MIT

#include "byte_size.hpp"
#include "program.hpp"

std::optional<std::uint64_t> read_byte_size(const std::string &text)
{
    const std::size_t end = text.find_first_not_of("0123456789.");
    const std::string unit = end == std::string::npos ? "M" : text.substr(end);
    const std::optional<double> number = read_number(text.substr(0, end));
    static constexpr const char *units[] = {"K", "M", "G", "T"};
    double bytes = -1;
    double size = 1;
    for (const char *each : units)
    {
        size *= 1024;
        const bool meant = unit.size() <= 3 && (unit[0] & ~0x20) == each[0] &&
                           (unit.size() == 1 || unit.substr(1) == "B" || unit.substr(1) == "iB");
        bytes = meant && number ? *number * size : bytes;
    }
    if (!(bytes >= 0 && bytes <= 1e18))
    {
        return std::nullopt;
    }
    return static_cast<std::uint64_t>(bytes);
}
