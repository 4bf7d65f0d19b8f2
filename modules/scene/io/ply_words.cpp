// SPDX-License-Identifier: MIT

#include "ply_words.hpp"

#include "modules/image/io/file_words.h"

#include <cmath>
#include <cstring>

namespace
{

struct PlyTypeName
{
    const char *name;
    PlyType type;
};

constexpr PlyTypeName type_names[] = {
    {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
    {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
    {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
    {"float64", PlyType::float64}};

PlyType ply_type_of(std::string_view word)
{
    for (const PlyTypeName &each : type_names)
    {
        if (word == each.name)
        {
            return each.type;
        }
    }
    return PlyType::none;
}

std::size_t ply_type_size(PlyType type)
{
    switch (type)
    {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::float64:
        return 8;
    default:
        return 4;
    }
}

template <typename Value> double value_of(const unsigned char *bytes)
{
    Value value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

double ply_value(PlyType type, const unsigned char *bytes)
{
    switch (type)
    {
    case PlyType::int8:
        return value_of<std::int8_t>(bytes);
    case PlyType::uint8:
        return value_of<std::uint8_t>(bytes);
    case PlyType::int16:
        return value_of<std::int16_t>(bytes);
    case PlyType::uint16:
        return value_of<std::uint16_t>(bytes);
    case PlyType::int32:
        return value_of<std::int32_t>(bytes);
    case PlyType::uint32:
        return value_of<std::uint32_t>(bytes);
    case PlyType::float32:
        return value_of<float>(bytes);
    default:
        return value_of<double>(bytes);
    }
}

std::vector<std::string_view> split_words(std::string_view line)
{
    std::vector<std::string_view> words;
    constexpr std::string_view apart = " \t\r";
    std::size_t begin = line.find_first_not_of(apart);
    while (begin != std::string_view::npos)
    {
        const std::size_t end = std::min(line.find_first_of(apart, begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(apart, end);
    }
    return words;
}

} // namespace

PlySource::PlySource(const std::string &file_name, std::string_view bytes)
    : name(file_name), text(bytes)
{
    read_head();
    check_counts();
}

void PlySource::fail(const std::string &what, cm_status status) const
{
    if (binary && line == 0)
    {
        fail_file(name, what, status);
    }
    fail_line(name, line, what, status);
}

std::string_view PlySource::next_line()
{
    if (at >= text.size())
    {
        fail("the file ends too early");
    }
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view whole = text.substr(at, end - at);
    at = std::min(end + 1, text.size());
    ++line;
    return whole;
}

void PlySource::read_head()
{
    std::string_view first = next_line();
    first = first.substr(0, first.find('\r'));
    if (first != "ply")
    {
        fail("is not a PLY file");
    }
    for (;;)
    {
        const std::vector<std::string_view> parts = split_words(next_line());
        if (!parts.empty() && parts[0] == "end_header")
        {
            break;
        }
        if (!parts.empty() && parts[0] != "comment" && parts[0] != "obj_info")
        {
            read_head_line(parts);
        }
    }
    if (!has_format)
    {
        fail("the head names no format");
    }
    line = binary ? 0 : line; // there are no lines behind it
}

void PlySource::read_head_line(const std::vector<std::string_view> &parts)
{
    if (parts[0] == "format" && parts.size() == 3 && !has_format)
    {
        if (parts[1] == "binary_big_endian")
        {
            fail("big-endian files are not read", CM_ERROR_UNSUPPORTED);
        }
        if ((parts[1] != "ascii" && parts[1] != "binary_little_endian") || parts[2] != "1.0")
        {
            fail("no such format");
        }
        binary = parts[1] != "ascii";
        has_format = true;
        // from here on lines have numbers all the same, until the head ends
    }
    else if (parts[0] == "element" && parts.size() == 3)
    {
        double count = 0.0;
        if (!word_number(parts[2], count) || !(count >= 0.0 && count < 0x1p53) ||
            count != std::floor(count))
        {
            fail("an element's number is no whole number");
        }
        list.push_back({std::string(parts[1]), static_cast<std::uint64_t>(count), {}});
    }
    else if (parts[0] == "property" && !list.empty() &&
             (parts.size() == 3 || (parts.size() == 5 && parts[1] == "list")))
    {
        const bool is_list = parts.size() == 5;
        const PlyProperty property = {std::string(parts.back()), is_list,
                                      is_list ? ply_type_of(parts[2]) : PlyType::none,
                                      ply_type_of(parts[parts.size() - 2])};
        if (property.type == PlyType::none ||
            (is_list && (property.count == PlyType::none || is_real(property.count))))
        {
            fail("a property of no such type");
        }
        list.back().properties.push_back(property);
    }
    else
    {
        fail("is no line of a PLY head");
    }
}

// Each row takes a byte at least: numbers that the file cannot hold are refused before memory is asked for.
void PlySource::check_counts() const
{
    std::uint64_t left = text.size() - at;
    for (const PlyElement &element : list)
    {
        if (element.properties.empty() && element.count > 0)
        {
            fail("an element without properties");
        }
        if (element.count > left)
        {
            fail("the file is too short for its " + std::to_string(element.count) + " of " +
                 element.name.substr(0, 40));
        }
        left -= element.count;
    }
}

void PlySource::begin_row(const PlyElement &)
{
    if (binary)
    {
        return;
    }
    if (word != words.size())
    {
        fail("a line has more numbers than are wanted");
    }
    do
    {
        words = split_words(next_line());
    } while (words.empty());
    word = 0;
}

double PlySource::take(PlyType type)
{
    if (!binary)
    {
        double value = 0.0;
        if (word >= words.size())
        {
            fail("a line has fewer numbers than are wanted");
        }
        const std::string_view number = words[word++];
        if (!word_number(number, value))
        {
            const bool no_number = is_real(type) && (number == "nan" || number == "-nan");
            const bool infinite = is_real(type) && (number == "inf" || number == "-inf");
            if (!no_number && !infinite)
            {
                fail("\"" + std::string(number.substr(0, 40)) + "\" is no number");
            }
            value = no_number ? NAN : number[0] == '-' ? -INFINITY : INFINITY;
        }
        return value;
    }
    const std::size_t size = ply_type_size(type);
    if (text.size() - at < size)
    {
        fail("the file ends too early");
    }
    unsigned char bytes[8];
    std::memcpy(bytes, text.data() + at, size);
    cm_file_order(bytes, 1, size, true);
    at += size;
    return ply_value(type, bytes);
}

std::uint64_t PlySource::take_count(const PlyProperty &property)
{
    const double count = take(property.count);
    if (!(count >= 0.0 && count <= 4294967295.0) || count != std::floor(count))
    {
        fail("a list has no such number of entries");
    }
    return static_cast<std::uint64_t>(count);
}

void PlySource::skip_list(const PlyProperty &property)
{
    for (std::uint64_t left = take_count(property); left > 0; --left)
    {
        take(property.type);
    }
}

void PlySource::check_end() const
{
    const bool blank = text.find_first_not_of(" \t\r\n", at) == std::string_view::npos;
    if (word != words.size() || (binary ? at != text.size() : !blank))
    {
        fail("there is more than the head says");
    }
}
