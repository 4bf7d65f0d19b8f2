// SPDX-License-Identifier: MIT

#include "json_text.hpp"

#include <cstdio>

std::string quoted(const std::string &text)
{
    std::string result = "\"";
    for (const char letter : text)
    {
        const auto code = static_cast<unsigned char>(letter);
        if (code < ' ')
        {
            char escape[8];
            std::snprintf(escape, sizeof escape, "\\u%04x", code);
            result += escape;
            continue;
        }
        result += letter == '"' || letter == '\\' ? "\\" : "";
        result += letter;
    }
    return result + "\"";
}
