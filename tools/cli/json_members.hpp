// SPDX-License-Identifier: MIT
//
// Members of JSON objects, taken by name and told by line when they are wrong.

#ifndef CUBEMAP_TOOLS_TOF_JSON_HPP
#define CUBEMAP_TOOLS_TOF_JSON_HPP

#include "modules/scene/io/parsed_json.hpp"

#include <string>
#include <string_view>
#include <vector>

// What a number may be.
enum class Range
{
    any,
    above_zero,
    zero_or_more,
    part,          // above 0 to 1
    part_with_zero // 0 to 1
};

// The file that an object is in.
struct JsonPlace
{
    std::string name;
    std::string_view text;

    // Failure "FILE:LINE: what": the line where the key first stands.
    [[noreturn]] void fail(const std::string &key, const std::string &what) const;
};

// An object of a file; path is how messages name it: "" or "lights[0].". All must outlive this.
class JsonMembers
{
public:
    JsonMembers(const JsonPlace &from, std::string path_name, const cJSON *json);

    // Failure for a member that none of the calls below has asked for, and for one that is there twice.
    void check_known() const;

    const cJSON *find(const char *key);
    // The number; 0 if it is absent. Failure if it is none, or outside the range; so if 0 is.
    double number(const char *key, Range range);
    // The same of a whole number from low to high, if it is there.
    long whole(const char *key, long low, long high, long absent);
    // Numbers of a list; none if it is absent.
    std::vector<double> numbers(const char *key, Range range);
    void vector(const char *key, double to[3]);
    [[noreturn]] void fail(const std::string &key, const std::string &what) const;

private:
    double checked(const cJSON *item, const std::string &key, Range range) const;

    const JsonPlace &place;
    std::string path;
    const cJSON *object;
    std::vector<std::string> known;
};

#endif
