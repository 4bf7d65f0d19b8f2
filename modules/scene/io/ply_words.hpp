// SPDX-License-Identifier: MIT
//
// The head of a PLY file and its numbers, in text or binary, one after the other.

#ifndef CUBEMAP_MODULES_SCENE_PLY_WORDS_HPP
#define CUBEMAP_MODULES_SCENE_PLY_WORDS_HPP

#include "file_failure.hpp"

#include <string>
#include <string_view>
#include <vector>

enum class PlyType
{
    none,
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    float32,
    float64
};

constexpr bool is_real(PlyType type)
{
    return type == PlyType::float32 || type == PlyType::float64;
}

struct PlyProperty
{
    std::string name;
    bool is_list = false;
    PlyType count = PlyType::none; // of a list
    PlyType type = PlyType::none;
};

struct PlyElement
{
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

// Reads the head when it is made; then the numbers as they are asked for. All failures name the file.
class PlySource
{
public:
    PlySource(const std::string &file_name, std::string_view bytes);

    const std::vector<PlyElement> &elements() const
    {
        return list;
    }
    // The next row of an element: of text a line.
    void begin_row(const PlyElement &element);
    double take(PlyType type);
    std::uint64_t take_count(const PlyProperty &property);
    void skip_list(const PlyProperty &property);
    // Is nothing left? Blank lines may be.
    void check_end() const;
    [[noreturn]] void fail(const std::string &text, cm_status status = CM_ERROR_DATA) const;

private:
    std::string_view next_line();
    void read_head();
    void read_head_line(const std::vector<std::string_view> &words);
    void check_counts() const;

    std::string name;
    std::string_view text;
    std::size_t at = 0;
    std::size_t line = 0;
    bool binary = false;
    bool has_format = false;
    std::vector<std::string_view> words; // of the row
    std::size_t word = 0;
    std::vector<PlyElement> list;
};

#endif
