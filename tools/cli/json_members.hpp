// SPDX-License-Identifier: MIT
//
// Members of JSON objects, taken by name and told by file and line when they are wrong.

#ifndef CUBEMAP_TOOLS_JSON_MEMBERS_HPP
#define CUBEMAP_TOOLS_JSON_MEMBERS_HPP

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

// A file that was read. Text and root must outlive this.
struct JsonPlace
{
    std::string name;
    std::string_view text;
    const cJSON *root;

    // Failure "FILE:LINE: what", the line where the item begins.
    [[noreturn]] void fail(const cJSON *item, const std::string &what) const;
};

// The object that a file is; Failure.
JsonPointer parse_json_file(const std::string &name, std::string_view text);

// An object of a file; path is how messages name it: "", or "lights[0]". The place must outlive this.
class JsonMembers
{
public:
    // Failure if it is no object.
    JsonMembers(const JsonPlace &from, std::string path_name, const cJSON *json);

    // Failure for a member that has none of these names, and for one that is there twice.
    void check_only(const std::vector<std::string> &names) const;
    // The same, the names being those that were asked for until now.
    void check_known() const;

    const cJSON *find(const char *key);
    // The number; 0 if it is absent. Failure if it is none, or outside the range; so if 0 is.
    double number(const char *key, Range range);
    // The same of a range that ends at least and most.
    double number(const char *key, Range range, double least, double most);
    // The number if it is there, else what is there stays.
    void take_number(const char *key, Range range, double &to);
    // The same of a whole number from low to high.
    long whole(const char *key, long low, long high, long absent);
    // Numbers of a list; none if it is absent.
    std::vector<double> numbers(const char *key, Range range);
    // So many numbers of a list; what is there stays if the list is absent.
    void take_numbers(const char *key, Range range, double *to, std::size_t count);
    // The same of a list that must be there.
    void need_numbers(const char *key, Range range, double *to, std::size_t count);
    // A text; wanted says of which kind, "the name of a mesh".
    std::string word(const char *key, const std::string &wanted);

    // Failure of a member that is not there: what it would be, and which one may be meant for it.
    [[noreturn]] void fail_missing(const std::string &key, const std::string &wanted) const;
    // Failure of a member, "PATH.KEY" and what it is; of the whole, "PATH" and what it is.
    [[noreturn]] void fail(const std::string &key, const std::string &what) const;
    [[noreturn]] void fail_whole(const std::string &what) const;
    // How messages name a member.
    std::string name_of(const std::string &key) const;

private:
    double checked(const cJSON *item, const std::string &key, Range range) const;

    const JsonPlace &place;
    std::string path;
    const cJSON *object;
    std::vector<std::string> known;
};

#endif
