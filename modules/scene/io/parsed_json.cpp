// SPDX-License-Identifier: MIT

#include "parsed_json.hpp"
#include "text_begin.hpp"

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

// Counts the items before this one, in the order of the text, from at on: what is in it, then what is behind it.
bool count_before(const cJSON *at, const cJSON *item, std::size_t &count)
{
    for (; at != nullptr; at = at->next)
    {
        if (at == item)
        {
            return true;
        }
        ++count;
        if (count_before(at->child, item, count))
        {
            return true;
        }
    }
    return false;
}

bool is_space(char letter)
{
    return static_cast<unsigned char>(letter) <= 32; // as cJSON has it
}

// Behind a text in quotes, a number or a word that begins here.
std::size_t end_of_word(std::string_view text, std::size_t place)
{
    std::size_t end = place + 1;
    if (text[place] == '"')
    {
        while (end < text.size() && text[end] != '"')
        {
            end += text[end] == '\\' ? 2 : 1;
        }
        return std::min(end + 1, text.size());
    }
    while (end < text.size() && !is_space(text[end]) &&
           std::string_view(",:]}").find(text[end]) == std::string_view::npos)
    {
        ++end;
    }
    return end;
}

bool is_key(std::string_view text, std::size_t end)
{
    while (end < text.size() && is_space(text[end]))
    {
        ++end;
    }
    return end < text.size() && text[end] == ':';
}

// Is something within more lists and objects than cJSON reads?
bool is_too_deep(std::string_view text)
{
    std::size_t depth = 0;
    std::size_t place = 0;
    while (place < text.size() && depth <= CJSON_NESTING_LIMIT)
    {
        const char letter = text[place];
        depth += letter == '{' || letter == '[' ? 1 : 0;
        depth -= (letter == '}' || letter == ']') && depth > 0 ? 1 : 0;
        place = letter == '"' ? end_of_word(text, place) : place + 1;
    }
    return depth > CJSON_NESTING_LIMIT;
}

// Where the item with this number begins, or its key.
std::size_t place_of_item(std::string_view text, std::size_t number)
{
    std::size_t begin = std::string_view::npos; // of the key, if there is one
    std::size_t place = begin_of_text(text);
    for (std::size_t seen = 0; place < text.size();)
    {
        if (is_space(text[place]) ||
            std::string_view(",:]}").find(text[place]) != std::string_view::npos)
        {
            ++place;
            continue;
        }
        const bool opens = text[place] == '{' || text[place] == '[';
        const std::size_t end = opens ? place + 1 : end_of_word(text, place);
        begin = begin == std::string_view::npos ? place : begin;
        if (text[place] != '"' || !is_key(text, end))
        {
            if (seen == number)
            {
                return begin;
            }
            ++seen;
            begin = std::string_view::npos;
        }
        place = end;
    }
    return 0;
}

} // namespace

std::size_t line_of_item(std::string_view text, const cJSON *root, const cJSON *item)
{
    std::size_t number = 0;
    return count_before(root, item, number) ? line_of_place(text, place_of_item(text, number)) : 1;
}

std::string_view text_of_item(std::string_view text, const cJSON *root, const cJSON *item)
{
    std::size_t number = 0;
    std::size_t place = count_before(root, item, number) ? place_of_item(text, number) : 0;
    const std::size_t behind_word = end_of_word(text, place);
    if (text[place] == '"' && is_key(text, behind_word))
    {
        place = text.find(':', behind_word) + 1;
    }
    while (place < text.size() && is_space(text[place]))
    {
        ++place;
    }
    std::size_t depth = 0;
    std::size_t end = place;
    do
    {
        const bool opens = text[end] == '{' || text[end] == '[';
        const bool closes = text[end] == '}' || text[end] == ']';
        const bool parts = is_space(text[end]) || text[end] == ',' || text[end] == ':';
        depth = opens ? depth + 1 : closes ? depth - 1 : depth;
        end = opens || closes || parts ? end + 1 : end_of_word(text, end);
    } while (depth > 0 && end < text.size());
    return text.substr(place, end - place);
}

std::size_t line_of_place(std::string_view text, std::size_t place)
{
    const std::string_view before = text.substr(0, std::min(place, text.size()));
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

JsonPointer parse_json_object(std::string_view text, JsonFault &fault)
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
    fault.what = json == nullptr && is_too_deep(text.substr(0, place + 1))
                     ? "has JSON of more than " + std::to_string(CJSON_NESTING_LIMIT) +
                           " lists and objects within each other, which is not read"
                     : "is no JSON object";
    fault.line = line_of_place(text, json == nullptr ? place : more == text.size() ? 0 : more);
    return JsonPointer(nullptr, cJSON_Delete);
}
