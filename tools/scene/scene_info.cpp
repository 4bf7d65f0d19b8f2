// SPDX-License-Identifier: MIT

#include "scene_sequence.hpp"

#include "modules/scene/io/camera_file.h"
#include "tools/cli/scene_handle.hpp"
#include "scene_table.h"
#include "tools/cli/program.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace
{

// Of the depths that were measured, in metres, over all views.
struct DepthStatistics
{
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0;
    double sum = 0;
    double measured = 0;
    double pixels = 0;
    bool is_whole = true; // in whole units

    void add(double depth)
    {
        pixels += 1;
        if (std::isfinite(depth) && depth > 0)
        {
            least = std::min(least, depth);
            greatest = std::max(greatest, depth);
            sum += depth;
            measured += 1;
        }
    }
};

void add_picture(const cm_view &view, DepthStatistics &statistics)
{
    const cm_image &image = view.depth;
    const bool is_float = image.type == CM_PIXEL_FLOAT;
    statistics.is_whole = statistics.is_whole && !is_float;
    const std::ptrdiff_t step = image.pixel_stride != 0 ? image.pixel_stride : (is_float ? 4 : 2);
    const std::ptrdiff_t row_step =
        image.row_stride != 0 ? image.row_stride : step * static_cast<std::ptrdiff_t>(image.width);
    for (std::uint32_t row = 0; row < image.height; ++row)
    {
        const char *at = static_cast<const char *>(image.data) + row * row_step;
        for (std::uint32_t column = 0; column < image.width; ++column, at += step)
        {
            const double stored = is_float
                                      ? static_cast<double>(*reinterpret_cast<const float *>(at))
                                      : *reinterpret_cast<const std::uint16_t *>(at);
            statistics.add(stored * view.depth_unit);
        }
    }
}

std::string camera_text(const cm_sequence_report &report)
{
    char *text = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(cm_camera_file_format(report.camera, report.depth_scale, &text, message), message);
    const std::unique_ptr<char, void (*)(void *)> owned(text, std::free);
    std::string line = text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
}

// Metres: half a unit of whole ones.
double rounding_of(const cm_sequence_report &report, const DepthStatistics &depth)
{
    return depth.is_whole ? 0.5 / report.depth_scale : 0.0;
}

std::string info_json(const cm_sequence_report &report, const DepthStatistics &depth)
{
    const auto whole = [](std::size_t number) { return std::to_string(number); };
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    const bool any = depth.measured > 0;
    std::string text = std::string("{\"layout\": \"") + cm_sequence_layout_name(report.layout) +
                       "\", \"views\": " + whole(report.count);
    text += ", \"listed\": " + whole(report.listed) +
            ", \"skipped\": " + whole(report.absent + report.without_pose) +
            ", \"absent\": " + whole(report.absent) +
            ", \"without_pose\": " + whole(report.without_pose) +
            ", \"without_color\": " + whole(report.without_color) +
            ", \"poses\": " + whole(report.poses);
    text += ", \"first\": " + json_number(report.first) + ", \"last\": " + json_number(report.last);
    text += ", \"camera\": " + camera_text(report) + ", \"depth\": {\"is_range\": " +
            (cm_camera_describe(report.camera)->mapping != nullptr ? "true" : "false");
    text += ", \"min\": " + json_number(any ? depth.least : nothing) +
            ", \"max\": " + json_number(any ? depth.greatest : nothing) +
            ", \"mean\": " + json_number(any ? depth.sum / depth.measured : nothing) +
            ", \"measured\": " + json_number(depth.measured / depth.pixels) +
            ", \"rounded_by\": " + json_number(rounding_of(report, depth));
    return text + "}}\n";
}

std::string info_text(const cm_sequence_report &report, const DepthStatistics &depth)
{
    const cm_camera_options &camera = *cm_camera_describe(report.camera);
    char text[600];
    std::snprintf(text, sizeof text,
                  "%s: %zu views of %u x %u from %.6f to %.6f s, %zu poses\n"
                  "%zu depth images listed, %zu absent, %zu without a pose; %zu views without "
                  "colours\n",
                  cm_sequence_layout_name(report.layout), report.count, camera.width, camera.height,
                  report.first, report.last, report.poses, report.listed, report.absent,
                  report.without_pose, report.without_color);
    const std::string lines = text;
    const char *const kind = camera.mapping != nullptr ? "range" : "depth";
    if (!(depth.measured > 0))
    {
        return lines + kind + " nowhere: no pixel is measured\n";
    }
    std::snprintf(text, sizeof text,
                  "%s %.6g to %.6g m, mean %.6g, rounded by up to %.3g mm; %.4g %% of the pixels "
                  "measured\n",
                  kind, depth.least, depth.greatest, depth.sum / depth.measured,
                  1e3 * rounding_of(report, depth), 100 * depth.measured / depth.pixels);
    return lines + text;
}

} // namespace

int tell_scene(int argc, char **argv, const cm_streams &streams)
{
    std::string camera;
    bool json = false;
    OptionReader reader(scene_info_command, argc, argv, streams);
    while (const int id = reader.next())
    {
        json = json || id == SCENE_JSON;
        camera = id == SCENE_CAMERA ? reader.text() : camera;
    }
    if (reader.printed())
    {
        return 0;
    }
    const std::vector<std::string> names = reader.operands();
    if (names.size() != 1)
    {
        throw UsageFailure("one folder is needed, " + std::to_string(names.size()) +
                           " are given; see --help");
    }
    const SequencePointer sequence = open_sequence(names.front(), camera);
    DepthStatistics depth;
    for_each_view(sequence.get(), [&depth](const cm_view &view) { add_picture(view, depth); });
    const cm_sequence_report &report = *cm_sequence_describe(sequence.get());
    print(streams, json ? info_json(report, depth) : info_text(report, depth));
    return 0;
}
