// SPDX-License-Identifier: MIT
//
// Where a text begins.

#ifndef CUBEMAP_MODULES_SCENE_TEXT_BEGIN_HPP
#define CUBEMAP_MODULES_SCENE_TEXT_BEGIN_HPP

#include <cstddef>
#include <string_view>

// Of UTF-8, which some editors begin a text with.
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

// Behind that.
inline std::size_t begin_of_text(std::string_view text)
{
    return text.substr(0, byte_order_mark.size()) == byte_order_mark ? byte_order_mark.size() : 0;
}

#endif
