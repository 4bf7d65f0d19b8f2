// SPDX-License-Identifier: MIT

#include "tof_json.hpp"

#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>

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

} // namespace

void JsonPlace::fail(const std::string &key, const std::string &what) const
{
    const std::size_t at = text.find("\"" + key + "\"");
    const std::size_t line = line_of_place(text, at == std::string_view::npos ? 0 : at);
    throw Failure(in_quotes(name) + ":" + std::to_string(line) + ": " + what);
}

JsonMembers::JsonMembers(const JsonPlace &from, std::string path_name, const cJSON *json)
    : place(from), path(std::move(path_name)), object(json)
{
}

void JsonMembers::fail(const std::string &key, const std::string &what) const
{
    place.fail(key, path + key + what);
}

void JsonMembers::check_known() const
{
    std::vector<std::string> seen;
    for (const cJSON *each = object->child; each != nullptr; each = each->next)
    {
        const std::string key = each->string;
        if (std::find(known.begin(), known.end(), key) == known.end())
        {
            place.fail(key, in_quotes(path + key.substr(0, 60)) + " is no member of a sensor");
        }
        if (std::find(seen.begin(), seen.end(), key) != seen.end())
        {
            fail(key, " is given twice");
        }
        seen.push_back(key);
    }
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
        fail(key, std::string(" is missing: ") + words_of_range(range));
    }
    return item == nullptr ? 0 : checked(item, key, range);
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

void JsonMembers::vector(const char *key, double to[3])
{
    const std::vector<double> list = numbers(key, Range::any);
    if (!list.empty() && list.size() != 3)
    {
        fail(key, " is not a list of 3 numbers");
    }
    std::copy(list.begin(), list.end(), to);
}
