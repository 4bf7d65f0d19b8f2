// SPDX-License-Identifier: MIT

#include "octree_views.hpp"

#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>

namespace
{

void check_position(const cm_octree_options &map, const cm_pose &pose, double time,
                    std::uint64_t number, const std::string &folder)
{
    const double edge = std::ldexp(map.edge, map.levels);
    double beyond = 0;
    for (int i = 0; i < 3; ++i)
    {
        beyond = std::max(beyond, std::fabs(pose.position[i] - map.centre[i]) - 0.5 * edge);
    }
    if (!(beyond <= edge))
    {
        char text[300];
        std::snprintf(text, sizeof text,
                      ": view %llu at %.6f s is %.6g from the map, which is %.6g wide: its pose is "
                      "wrong, or --centre, or --levels",
                      static_cast<unsigned long long>(number), time, beyond, edge);
        throw Failure(in_quotes(folder) + text);
    }
}

} // namespace

bool is_measured(const cm_view &view)
{
    const cm_image &image = view.depth;
    const bool is_float = image.type == CM_PIXEL_FLOAT;
    const std::ptrdiff_t step = image.pixel_stride != 0 ? image.pixel_stride : (is_float ? 4 : 2);
    const std::ptrdiff_t row_step =
        image.row_stride != 0 ? image.row_stride : step * static_cast<std::ptrdiff_t>(image.width);
    for (std::uint32_t row = 0; row < image.height; ++row)
    {
        const char *at =
            static_cast<const char *>(image.data) + static_cast<std::ptrdiff_t>(row) * row_step;
        for (std::uint32_t column = 0; column < image.width; ++column, at += step)
        {
            if (is_float ? *reinterpret_cast<const float *>(at) > 0.0f &&
                               std::isfinite(*reinterpret_cast<const float *>(at))
                         : *reinterpret_cast<const std::uint16_t *>(at) != 0)
            {
                return true;
            }
        }
    }
    return false;
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

void check_near_map(const cm_octree_options &map, const cm_view &view, std::uint64_t number,
                    const std::string &folder)
{
    check_position(map, view.pose, view.time, number, folder);
}

void check_poses(const cm_sequence *sequence, const cm_octree_options &map,
                 const std::string &folder)
{
    const std::size_t count = cm_sequence_count(sequence);
    for (std::size_t i = 0; count != CM_SEQUENCE_UNKNOWN && i < count; ++i)
    {
        cm_sequence_entry entry = {};
        char message[CM_IMAGE_MESSAGE] = "";
        check_scene(cm_sequence_entry_at(sequence, i, &entry, message), message);
        check_position(map, entry.pose, entry.time, i + 1, folder);
    }
}
