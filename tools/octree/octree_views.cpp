// SPDX-License-Identifier: MIT

#include "octree_views.hpp"

#include "modules/scene/io/check_sum.h"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace
{

constexpr double farthest = 100; // in what a view measured

double stored_at(const char *at, bool is_float)
{
    const double stored = is_float ? static_cast<double>(*reinterpret_cast<const float *>(at))
                                   : *reinterpret_cast<const std::uint16_t *>(at);
    return std::isfinite(stored) ? stored : 0;
}

std::uint64_t file_sum(std::uint64_t sum, const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::array<char, 4096> bytes;
    while (file.read(bytes.data(), bytes.size()) || file.gcount() > 0)
    {
        sum = cm_check_sum(sum, bytes.data(), static_cast<std::size_t>(file.gcount()));
    }
    return sum;
}

} // namespace

std::uint64_t sequence_sum(const cm_sequence *sequence, const std::string &folder)
{
    std::uint64_t sum = CM_CHECK_SUM_BEGIN;
    const std::size_t count = cm_sequence_count(sequence);
    for (std::size_t i = 0; i < count; ++i)
    {
        cm_sequence_entry entry = {};
        char message[CM_IMAGE_MESSAGE] = "";
        check_scene(cm_sequence_entry_at(sequence, i, &entry, message), message);
        sum = cm_check_sum(sum, &entry.time, sizeof entry.time);
        sum = cm_check_sum(sum, &entry.pose, sizeof entry.pose);
        for (const char *name : {entry.depth, entry.color})
        {
            const std::string path = folder + "/" + (name == nullptr ? "" : name);
            sum = cm_check_sum(sum, path.data() + folder.size(), path.size() - folder.size());
            sum = i == 0 && name != nullptr ? file_sum(sum, path) : sum;
        }
    }
    return sum;
}

double greatest_depth(const cm_view &view)
{
    const cm_image &image = view.depth;
    const bool is_float = image.type == CM_PIXEL_FLOAT;
    const std::ptrdiff_t step = image.pixel_stride != 0 ? image.pixel_stride : (is_float ? 4 : 2);
    const std::ptrdiff_t row_step =
        image.row_stride != 0 ? image.row_stride : step * static_cast<std::ptrdiff_t>(image.width);
    double greatest = 0;
    for (std::uint32_t row = 0; row < image.height; ++row)
    {
        const char *at =
            static_cast<const char *>(image.data) + static_cast<std::ptrdiff_t>(row) * row_step;
        for (std::uint32_t column = 0; column < image.width; ++column, at += step)
        {
            greatest = std::max(greatest, stored_at(at, is_float));
        }
    }
    return greatest * view.depth_unit;
}

void for_views_from(cm_sequence *sequence, std::size_t first,
                    const std::function<void(const cm_view &)> &body)
{
    const std::size_t count = cm_sequence_count(sequence);
    const bool is_stream = count == CM_SEQUENCE_UNKNOWN;
    for (std::size_t i = is_stream ? 0 : first; i < count; ++i)
    {
        const cm_view *view = nullptr;
        char message[CM_IMAGE_MESSAGE] = "";
        const cm_status status = cm_sequence_view(sequence, i, &view, message);
        if (status == CM_ERROR_RANGE && is_stream && i > 0)
        {
            return;
        }
        check_scene(status, message);
        if (i >= first)
        {
            body(*view);
        }
    }
}

void check_near_map(const cm_octree_options &map, const cm_view &view, double depth,
                    std::uint64_t number, const std::string &folder)
{
    const double edge = std::ldexp(map.edge, map.levels);
    double beyond = 0;
    for (int i = 0; i < 3; ++i)
    {
        beyond = std::max(beyond, std::fabs(view.pose.position[i] - map.centre[i]) - 0.5 * edge);
    }
    if (beyond > std::max(edge, farthest * depth))
    {
        char text[300];
        std::snprintf(text, sizeof text,
                      ": view %llu at %.6f s is %.6g from the map, which is %.6g wide: its pose is "
                      "wrong, or --centre, or --levels",
                      static_cast<unsigned long long>(number), view.time, beyond, edge);
        throw Failure(in_quotes(folder) + text);
    }
}

Failure refused_depth(const cm_octree_options &map, const cm_view &view, double depth,
                      std::uint64_t number, const std::string &folder)
{
    char text[300];
    std::snprintf(text, sizeof text,
                  ": view %llu at %.6f s has depths up to %.6g, as if they were measured: all in "
                  "front of them would be free, in voxels of %.6g; --far says how far the "
                  "sensor sees",
                  static_cast<unsigned long long>(number), view.time, depth, map.edge);
    return Failure(in_quotes(folder) + text);
}
