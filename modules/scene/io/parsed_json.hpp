// SPDX-License-Identifier: MIT
//
// JSON of a whole text, by cJSON.

#ifndef CUBEMAP_MODULES_SCENE_PARSED_JSON_HPP
#define CUBEMAP_MODULES_SCENE_PARSED_JSON_HPP

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include <cjson/cJSON.h>

using JsonPointer = std::unique_ptr<cJSON, void (*)(cJSON *)>;

// Why a text is no object that is read, and the number of the line, from 1, where it goes wrong.
struct JsonFault
{
    std::size_t line = 0;
    std::string what;
};

// The object that the whole text is. If it is none: nullptr, and the fault.
// Throws std::bad_alloc, which cJSON does not tell from a wrong text.
JsonPointer parse_json_object(std::string_view text, JsonFault &fault);

// The number of the line, from 1, where an item begins, with its key, in the text that root was parsed from.
std::size_t line_of_item(std::string_view text, const cJSON *root, const cJSON *item);

// What an item is in the text that root was parsed from, without its key.
std::string_view text_of_item(std::string_view text, const cJSON *root, const cJSON *item);

// The number of the line, from 1, of a place in a text.
std::size_t line_of_place(std::string_view text, std::size_t place);

#endif
