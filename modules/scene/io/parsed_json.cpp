// SPDX-License-Identifier: MIT

#include "parsed_json.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace
{

// Of this thread: did cJSON find no memory?
thread_local bool json_starved = false;

void *json_memory(std::size_t size)
{
    void *const block = std::malloc(size);
    json_starved = json_starved || block == nullptr;
    return block;
}

// Once for the process, whose other users of cJSON have memory as before.
void note_memory_of_json()
{
    static const bool noted = []
    {
        cJSON_Hooks hooks = {json_memory, std::free};
        cJSON_InitHooks(&hooks);
        return true;
    }();
    static_cast<void>(noted);
}

} // namespace

std::size_t line_of_place(std::string_view text, std::size_t place)
{
    const std::string_view before = text.substr(0, std::min(place, text.size()));
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

JsonPointer parse_json_object(std::string_view text, std::size_t &line)
{
    note_memory_of_json();
    json_starved = false;
    const char *end = nullptr;
    JsonPointer json(cJSON_ParseWithLengthOpts(text.data(), text.size(), &end, 0), cJSON_Delete);
    if (json_starved)
    {
        throw std::bad_alloc();
    }
    const std::size_t place = end == nullptr ? 0 : static_cast<std::size_t>(end - text.data());
    const std::size_t more = std::min(text.find_first_not_of(" \t\r\n", place), text.size());
    if (json != nullptr && more == text.size() && cJSON_IsObject(json.get()))
    {
        return json;
    }
    line = line_of_place(text, json == nullptr ? place : more == text.size() ? 0 : more);
    return JsonPointer(nullptr, cJSON_Delete);
}
