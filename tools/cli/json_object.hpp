// SPDX-License-Identifier: MIT
//
// JSON files (RFC 8259) of one object, as programs here write them.

#ifndef CUBEMAP_TOOLS_JSON_OBJECT_HPP
#define CUBEMAP_TOOLS_JSON_OBJECT_HPP

#include <map>
#include <optional>
#include <string>
#include <vector>

// Texts, and numbers as they are written, by their keys; those of an array one after another. Members that are objects,
// arrays of arrays, true, false or null are left out.
using JsonObject = std::map<std::string, std::vector<std::string>>;

// Nothing if the text is not a JSON object.
std::optional<JsonObject> read_json_object(const std::string &text);

#endif
