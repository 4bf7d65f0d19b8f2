// SPDX-License-Identifier: MIT

#include "ply_file.h"

#include "ply_words.hpp"

#include "modules/image/io/file_words.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace
{

constexpr std::uint64_t ply_bytes_most = std::uint64_t{1} << 36;

// The columns of a vertex that are wanted: x y z, nx ny nz, red green blue.
constexpr std::size_t wanted_columns = 9;
const char *const wanted_names[wanted_columns] = {"x",  "y",   "z",     "nx",  "ny",
                                                  "nz", "red", "green", "blue"};

struct PlyArrays
{
    std::vector<double> position;
    std::vector<float> normal;
    std::vector<unsigned char> color;
    std::vector<std::uint32_t> corner;
};

struct PlyColumns
{
    std::vector<int> place; // of a property: which of the wanted, or -1
    bool normals = false;
    bool colors = false;
    double scale[wanted_columns] = {}; // of a colour, to 255
};

PlyColumns columns_of(const PlySource &source, const PlyElement &element)
{
    PlyColumns columns;
    int found[wanted_columns] = {};
    for (const PlyProperty &property : element.properties)
    {
        int place = -1;
        for (std::size_t i = 0; i < wanted_columns && !property.is_list; ++i)
        {
            place = property.name == wanted_names[i] ? static_cast<int>(i) : place;
        }
        columns.place.push_back(place);
        if (place >= 0 && found[place]++ != 0)
        {
            source.fail("vertices have " + property.name + " twice");
        }
        if (place >= 0)
        {
            columns.scale[place] = is_real(property.type) ? 255.0 : 1.0;
        }
    }
    if (found[0] + found[1] + found[2] != 3)
    {
        source.fail("vertices have no x, y and z");
    }
    columns.normals = found[3] + found[4] + found[5] == 3;
    columns.colors = found[6] + found[7] + found[8] == 3;
    return columns;
}

void take_points(PlySource &source, const PlyElement &element, PlyArrays &arrays)
{
    const PlyColumns columns = columns_of(source, element);
    for (std::uint64_t i = 0; i < element.count; ++i)
    {
        double row[wanted_columns] = {};
        source.begin_row(element);
        for (std::size_t k = 0; k < element.properties.size(); ++k)
        {
            const PlyProperty &property = element.properties[k];
            if (property.is_list)
            {
                source.skip_list(property);
                continue;
            }
            const double value = source.take(property.type);
            if (columns.place[k] >= 0)
            {
                row[columns.place[k]] = value;
            }
        }
        arrays.position.insert(arrays.position.end(), row, row + 3);
        for (std::size_t k = 3; k < 6 && columns.normals; ++k)
        {
            arrays.normal.push_back(static_cast<float>(row[k]));
        }
        for (std::size_t k = 6; k < 9 && columns.colors; ++k)
        {
            const double value = row[k] * columns.scale[k];
            if (!(value >= 0.0 && value <= 255.0))
            {
                source.fail("a colour is not from 0 to 255, or from 0 to 1");
            }
            arrays.color.push_back(static_cast<unsigned char>(value + 0.5));
        }
    }
}

void take_polygon(PlySource &source, const PlyProperty &property, std::uint64_t points,
                  PlyArrays &arrays)
{
    const std::uint64_t corners = source.take_count(property);
    if (corners < 3)
    {
        source.fail("a face has fewer than 3 corners");
    }
    std::uint32_t first = 0;
    std::uint32_t before = 0;
    for (std::uint64_t i = 0; i < corners; ++i)
    {
        const double index = source.take(property.type);
        if (!(index >= 0.0 && index < static_cast<double>(points)) || index != std::floor(index))
        {
            source.fail("a face has a corner that is no vertex");
        }
        const std::uint32_t corner = static_cast<std::uint32_t>(index);
        if (i >= 2)
        {
            arrays.corner.insert(arrays.corner.end(), {first, before, corner});
        }
        first = i == 0 ? corner : first;
        before = corner;
    }
}

void take_faces(PlySource &source, const PlyElement &element, std::uint64_t points,
                PlyArrays &arrays)
{
    for (std::uint64_t i = 0; i < element.count; ++i)
    {
        source.begin_row(element);
        for (const PlyProperty &property : element.properties)
        {
            const bool corners = property.is_list && (property.name == "vertex_indices" ||
                                                      property.name == "vertex_index");
            if (corners)
            {
                take_polygon(source, property, points, arrays);
            }
            else if (property.is_list)
            {
                source.skip_list(property);
            }
            else
            {
                source.take(property.type);
            }
        }
    }
}

void skip_element(PlySource &source, const PlyElement &element)
{
    for (std::uint64_t i = 0; i < element.count; ++i)
    {
        source.begin_row(element);
        for (const PlyProperty &property : element.properties)
        {
            if (property.is_list)
            {
                source.skip_list(property);
            }
            else
            {
                source.take(property.type);
            }
        }
    }
}

template <typename Value> Value *array_of(const std::vector<Value> &values)
{
    if (values.empty())
    {
        return nullptr;
    }
    Value *const copy = static_cast<Value *>(std::malloc(values.size() * sizeof(Value)));
    if (copy == nullptr)
    {
        throw std::bad_alloc();
    }
    std::memcpy(copy, values.data(), values.size() * sizeof(Value));
    return copy;
}

// Of the one element "vertex", which may stand behind the faces. Two would not have the same columns.
std::uint64_t count_points(const PlySource &source)
{
    std::uint64_t points = 0;
    std::size_t found = 0;
    for (const PlyElement &element : source.elements())
    {
        if (element.name == "vertex")
        {
            points = element.count;
            ++found;
        }
    }
    if (found > 1)
    {
        source.fail("the head has the element vertex twice");
    }
    if (points > UINT32_MAX)
    {
        source.fail("it has more points than can be counted with 32 bits");
    }
    return points;
}

void parse_ply(const std::string &name, std::string_view bytes, cm_ply *ply)
{
    PlySource source(name, bytes);
    PlyArrays arrays;
    const std::uint64_t points = count_points(source);
    for (const PlyElement &element : source.elements())
    {
        if (element.name == "vertex")
        {
            take_points(source, element, arrays);
        }
        else if (element.name == "face")
        {
            take_faces(source, element, points, arrays);
        }
        else
        {
            skip_element(source, element);
        }
    }
    source.check_end();
    cm_ply made = {};
    try
    {
        made.point_count = static_cast<std::size_t>(points);
        made.position = array_of(arrays.position);
        made.normal = array_of(arrays.normal);
        made.color = array_of(arrays.color);
        made.triangle_count = arrays.corner.size() / 3;
        made.corner = array_of(arrays.corner);
    }
    catch (...)
    {
        cm_ply_clear(&made);
        throw;
    }
    *ply = made;
}

bool is_whole_ply(const cm_ply &ply)
{
    for (std::size_t i = 0; i < 3 * ply.triangle_count; ++i)
    {
        if (ply.corner == nullptr || ply.corner[i] >= ply.point_count)
        {
            return false;
        }
    }
    return ply.point_count == 0 || ply.position != nullptr;
}

template <typename Value> void append_bytes(std::string &bytes, Value value)
{
    char buffer[sizeof value];
    std::memcpy(buffer, &value, sizeof value);
    cm_file_order(buffer, 1, sizeof value, true);
    bytes.append(buffer, sizeof value);
}

std::string ply_head(const cm_ply &ply, bool binary)
{
    std::string text = std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") +
                       " 1.0\nelement vertex " + std::to_string(ply.point_count) +
                       "\nproperty double x\nproperty double y\nproperty double z\n";
    if (ply.normal != nullptr)
    {
        text += "property float nx\nproperty float ny\nproperty float nz\n";
    }
    if (ply.color != nullptr)
    {
        text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    if (ply.triangle_count > 0)
    {
        text += "element face " + std::to_string(ply.triangle_count) +
                "\nproperty list uchar uint vertex_indices\n";
    }
    return text + "end_header\n";
}

// One number as text, ended by a blank, or as bytes.
template <typename Value> void append_number(std::string &bytes, Value value, bool binary)
{
    if (binary)
    {
        append_bytes(bytes, value);
    }
    else if (std::isfinite(static_cast<double>(value)))
    {
        bytes += number_text(static_cast<double>(value)) + " ";
    }
    else
    {
        bytes += std::isnan(static_cast<double>(value)) ? "nan " : value > 0 ? "inf " : "-inf ";
    }
}

std::string ply_bytes(const cm_ply &ply, bool binary)
{
    std::string bytes = ply_head(ply, binary);
    const auto end_row = [&bytes, binary]
    {
        if (!binary)
        {
            bytes.back() = '\n';
        }
    };
    for (std::size_t i = 0; i < ply.point_count; ++i)
    {
        for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
        {
            append_number(bytes, ply.position[k], binary);
        }
        for (std::size_t k = 3 * i; k < 3 * i + 3 && ply.normal != nullptr; ++k)
        {
            append_number(bytes, ply.normal[k], binary);
        }
        for (std::size_t k = 3 * i; k < 3 * i + 3 && ply.color != nullptr; ++k)
        {
            append_number(bytes, ply.color[k], binary);
        }
        end_row();
    }
    for (std::size_t i = 0; i < ply.triangle_count; ++i)
    {
        append_number(bytes, static_cast<unsigned char>(3), binary);
        for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
        {
            append_number(bytes, ply.corner[k], binary);
        }
        end_row();
    }
    return bytes;
}

} // namespace

void cm_ply_clear(cm_ply *ply)
{
    if (ply != nullptr)
    {
        std::free(ply->position);
        std::free(ply->normal);
        std::free(ply->color);
        std::free(ply->corner);
        *ply = {};
    }
}

cm_status cm_ply_parse(const char *name, const void *bytes, size_t count, cm_ply *ply,
                       char *message)
{
    if (name == nullptr || bytes == nullptr || ply == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message,
                        [&] {
                            parse_ply(name, {static_cast<const char *>(bytes), count}, ply);
                        });
}

cm_status cm_ply_read(const char *path, cm_ply *ply, char *message)
{
    if (path == nullptr || ply == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { parse_ply(path, read_whole(path, ply_bytes_most), ply); });
}

cm_status cm_ply_write(const char *path, const cm_ply *ply, bool binary, char *message)
{
    if (path == nullptr || ply == nullptr || !is_whole_ply(*ply))
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { write_whole(path, ply_bytes(*ply, binary)); });
}
