// SPDX-License-Identifier: MIT
//
// Words of JSON.

#ifndef CUBEMAP_TOOLS_JSON_TEXT_HPP
#define CUBEMAP_TOOLS_JSON_TEXT_HPP

#include <string>

// In quotation marks; bytes that are no ASCII stay as they are.
std::string quoted(const std::string &text);

#endif
