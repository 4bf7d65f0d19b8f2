// SPDX-License-Identifier: MIT
//
// Words that people write in upper or lower case.

#ifndef CUBEMAP_TOOLS_LOWER_CASE_HPP
#define CUBEMAP_TOOLS_LOWER_CASE_HPP

#include <algorithm>
#include <string>

// With small letters of ASCII for large ones, in every locale.
inline std::string lower_case(std::string text)
{
    const auto lower_letter = [](char letter)
    { return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter; };
    std::transform(text.begin(), text.end(), text.begin(), lower_letter);
    return text;
}

#endif
