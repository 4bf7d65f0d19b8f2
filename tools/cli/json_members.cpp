// SPDX-License-Identifier: MIT

#include "json_members.hpp"

#include "nearest.h"
#include "program.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace
{

bool is_in(double value, Range range)
{
    switch (range)
    {
    case Range::above_zero:
        return value > 0;
    case Range::zero_or_more:
        return value >= 0;
    case Range::part:
        return value > 0 && value <= 1;
    case Range::part_with_zero:
        return value >= 0 && value <= 1;
    default:
        return true;
    }
}

const char *words_of_range(Range range)
{
    switch (range)
    {
    case Range::above_zero:
        return "a number above 0";
    case Range::zero_or_more:
        return "a number of 0 or more";
    case Range::part:
        return "a number above 0, at most 1";
    case Range::part_with_zero:
        return "a number from 0 to 1";
    default:
        return "a finite number";
    }
}

std::string suggestion_of(const std::string &key, const std::vector<std::string> &names)
{
    cm_nearest nearest = cm_nearest_to(key.data(), key.size());
    for (const std::string &each : names)
    {
        cm_nearest_try(&nearest, each.data(), each.size());
    }
    return suggestion(nearest);
}

// "; is 'frequecy' meant for it?" where a member that is missing seems to be there by another name. Short names are too much alike.
std::string misspelt(const cJSON *object, const std::string &key)
{
    constexpr std::size_t short_name = 4;
    cm_nearest nearest = cm_nearest_to(key.data(), key.size());
    for (const cJSON *each = object->child; each != nullptr; each = each->next)
    {
        cm_nearest_try(&nearest, each->string, std::strlen(each->string));
    }
    return nearest.best == nullptr || nearest.length < short_name
               ? ""
               : "; is " + in_quotes(nearest.best) + " meant for it?";
}

} // namespace

void JsonPlace::fail(const cJSON *item, const std::string &what) const
{
    throw Failure(in_quotes(name) + ":" + std::to_string(line_of_item(text, root, item)) + ": " +
                  what);
}

JsonPointer parse_json_file(const std::string &name, std::string_view text)
{
    JsonFault fault;
    JsonPointer made = parse_json_object(text, fault);
    if (made == nullptr)
    {
        throw Failure(in_quotes(name) + ":" + std::to_string(fault.line) + ": " + fault.what);
    }
    return made;
}

JsonMembers::JsonMembers(const JsonPlace &from, std::string path_name, const cJSON *json)
    : place(from), path(std::move(path_name)), object(json)
{
    if (!cJSON_IsObject(object))
    {
        fail_whole(" is no object");
    }
}

std::string JsonMembers::name_of(const std::string &key) const
{
    return path.empty() ? key : path + "." + key;
}

void JsonMembers::fail(const std::string &key, const std::string &what) const
{
    const cJSON *const item = cJSON_GetObjectItemCaseSensitive(object, key.c_str());
    place.fail(item == nullptr ? object : item, name_of(key) + what);
}

void JsonMembers::fail_missing(const std::string &key, const std::string &wanted) const
{
    fail(key, " is missing: " + wanted + misspelt(object, key));
}

void JsonMembers::fail_whole(const std::string &what) const
{
    place.fail(object, path + what);
}

void JsonMembers::check_only(const std::vector<std::string> &names) const
{
    std::vector<std::string> seen;
    for (const cJSON *each = object->child; each != nullptr; each = each->next)
    {
        const std::string key = each->string;
        if (std::find(names.begin(), names.end(), key) == names.end())
        {
            const std::string quoted = in_quotes(key.substr(0, 60));
            place.fail(each,
                       (path.empty() ? quoted + " means nothing there"
                                     : path + " has " + quoted + ", which means nothing there") +
                           suggestion_of(key, names));
        }
        if (std::find(seen.begin(), seen.end(), key) != seen.end())
        {
            place.fail(each, name_of(key) + " is given twice");
        }
        seen.push_back(key);
    }
}

void JsonMembers::check_known() const
{
    check_only(known);
}

const cJSON *JsonMembers::find(const char *key)
{
    known.emplace_back(key);
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

double JsonMembers::checked(const cJSON *item, const std::string &key, Range range) const
{
    if (!cJSON_IsNumber(item) || !std::isfinite(item->valuedouble))
    {
        fail(key, std::string(" is not ") + words_of_range(range));
    }
    if (!is_in(item->valuedouble, range))
    {
        char text[40];
        std::snprintf(text, sizeof text, "%g", item->valuedouble);
        fail(key, std::string(" is ") + text + ", not " + words_of_range(range));
    }
    return item->valuedouble;
}

double JsonMembers::number(const char *key, Range range)
{
    const cJSON *const item = find(key);
    if (item == nullptr && !is_in(0, range))
    {
        fail_missing(key, words_of_range(range));
    }
    return item == nullptr ? 0 : checked(item, key, range);
}

double JsonMembers::number(const char *key, Range range, double least, double most)
{
    const double value = number(key, range);
    if (!(value >= least && value <= most))
    {
        char text[120];
        std::snprintf(text, sizeof text, " is %g, not a number from %g to %g", value, least, most);
        fail(key, text);
    }
    return value;
}

void JsonMembers::take_number(const char *key, Range range, double &to)
{
    const cJSON *const item = find(key);
    to = item == nullptr ? to : checked(item, key, range);
}

long JsonMembers::whole(const char *key, long low, long high, long absent)
{
    const cJSON *const item = find(key);
    if (item == nullptr)
    {
        return absent;
    }
    const double value = cJSON_IsNumber(item) ? item->valuedouble : std::nan("");
    if (value != std::floor(value) || !(value >= static_cast<double>(low)) ||
        !(value <= static_cast<double>(high)))
    {
        fail(key,
             " is not a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    return static_cast<long>(value);
}

std::vector<double> JsonMembers::numbers(const char *key, Range range)
{
    std::vector<double> list;
    const cJSON *const item = find(key);
    if (item == nullptr)
    {
        return list;
    }
    if (!cJSON_IsArray(item) || item->child == nullptr)
    {
        fail(key, " is not a list of numbers");
    }
    for (const cJSON *each = item->child; each != nullptr; each = each->next)
    {
        list.push_back(checked(each, key, range));
    }
    return list;
}

void JsonMembers::take_numbers(const char *key, Range range, double *to, std::size_t count)
{
    if (find(key) != nullptr)
    {
        need_numbers(key, range, to, count);
    }
}

void JsonMembers::need_numbers(const char *key, Range range, double *to, std::size_t count)
{
    const cJSON *const list = find(key);
    if (!cJSON_IsArray(list) || static_cast<std::size_t>(cJSON_GetArraySize(list)) != count)
    {
        fail(key, " is not a list of " + std::to_string(count) + " numbers");
    }
    for (const cJSON *each = list->child; each != nullptr; each = each->next)
    {
        *to++ = checked(each, key, range);
    }
}

std::string JsonMembers::word(const char *key, const std::string &wanted)
{
    const cJSON *const item = find(key);
    if (!cJSON_IsString(item))
    {
        fail(key, " is not " + wanted);
    }
    return item->valuestring;
}
