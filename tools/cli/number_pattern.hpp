// SPDX-License-Identifier: MIT
//
// Names with a number in them, as C's printf and ffmpeg write them: frame_%04d.png.

#ifndef CUBEMAP_TOOLS_NUMBER_PATTERN_HPP
#define CUBEMAP_TOOLS_NUMBER_PATTERN_HPP

#include <optional>
#include <set>
#include <string>

struct NumberPattern
{
    std::string before;
    std::string after;
    unsigned width = 0; // the fewest characters of the number
    bool zeros = false; // are these filled up with zeros, or with blanks?

    // The name for a number, 0 or more.
    std::string name(int number) const;
};

// The pattern in a name, nothing if there is none. UsageFailure if there are two, or one in the name of a folder.
std::optional<NumberPattern> number_pattern(const std::string &name);

// The numbers for which there is something of that name.
std::set<int> present_numbers(const NumberPattern &pattern);

#endif
