// SPDX-License-Identifier: MIT

#include "scene_handle.hpp"

#include "modules/scene/io/camera_file.h"
#include "modules/scene/io/trajectory_file.h"
#include "parallel.hpp"
#include "program.hpp"

#include <cubemap/number.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

void check_scene(cm_status status, const char *message)
{
    if (status != CM_OK)
    {
        throw Failure(message[0] == '\0' ? cm_status_text(status) : message);
    }
}

CameraFile read_camera(const std::string &path)
{
    cm_camera *camera = nullptr;
    double depth_scale = 0;
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(cm_camera_file_read(path.c_str(), &camera, &depth_scale, message), message);
    return {CameraPointer(camera), depth_scale};
}

TimedPoses read_poses(const std::string &path)
{
    cm_pose_list list = {};
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(cm_trajectory_file_read(path.c_str(), &list, message), message);
    const std::unique_ptr<cm_pose_list, void (*)(cm_pose_list *)> owned(&list, cm_pose_list_clear);
    return {{list.time, list.time + list.count}, {list.pose, list.pose + list.count}};
}

SequencePointer open_sequence(const std::string &folder, const std::string &camera,
                              bool colors_will_do)
{
    cm_sequence_options options = {};
    options.size = sizeof options;
    options.colors_will_do = colors_will_do ? 1 : 0;
    options.camera = camera.empty() ? nullptr : camera.c_str();
    cm_sequence *sequence = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(cm_sequence_open(folder.c_str(), &options, &sequence, message), message);
    return SequencePointer(sequence);
}

void for_each_view(cm_sequence *sequence, const std::function<void(const cm_view &)> &body)
{
    const std::size_t count = cm_sequence_count(sequence);
    for (std::size_t i = 0; i < count; ++i)
    {
        const cm_view *view = nullptr;
        char message[CM_IMAGE_MESSAGE] = "";
        const cm_status status = cm_sequence_view(sequence, i, &view, message);
        if (status == CM_ERROR_RANGE && count == CM_SEQUENCE_UNKNOWN && i > 0)
        {
            return;
        }
        check_scene(status, message);
        body(*view);
    }
}

SequenceWriterPointer create_sequence(const std::string &folder, cm_sequence_layout layout,
                                      const cm_camera *camera, double depth_scale)
{
    if (folder == "-")
    {
        throw UsageFailure("-o is '-', not a folder to write");
    }
    auto signals = std::make_unique<SignalsHeld>();
    cm_sequence_writer *writer = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(cm_sequence_create(folder.c_str(), layout, camera, depth_scale, &writer, message),
                message);
    return SequenceWriterPointer(writer, {std::move(signals)});
}

void finish_sequence(const SequenceWriterPointer &writer)
{
    char message[CM_IMAGE_MESSAGE] = "";
    check_scene(cm_sequence_finish(writer.get(), message), message);
}

PoolPointer make_pool(int requested)
{
    const int threads = thread_count(requested);
    cm_pool *pool = nullptr;
    if (threads > 1 && cm_pool_create(static_cast<unsigned>(threads), &pool) != CM_OK)
    {
        throw std::bad_alloc();
    }
    return PoolPointer(pool);
}

double median_of(std::vector<double> numbers)
{
    if (numbers.empty())
    {
        return std::nan("");
    }
    std::sort(numbers.begin(), numbers.end());
    const std::size_t middle = numbers.size() / 2;
    return numbers.size() % 2 == 1 ? numbers[middle]
                                   : 0.5 * (numbers[middle - 1] + numbers[middle]);
}

std::string budget_text(const cm_budget &budget)
{
    std::size_t length = 0;
    cm_status status = cm_budget_json(&budget, nullptr, 0, &length);
    check_scene(status == CM_ERROR_SPACE ? CM_OK : status, "");
    std::string text(length + 1, '\0');
    check_scene(cm_budget_json(&budget, text.data(), text.size(), &length), "");
    text.resize(length);
    for (std::size_t end; (end = text.find('\n')) != std::string::npos;)
    {
        text.replace(end, text.find_first_not_of(" \n", end) - end, " "); // the result is a line
    }
    return text;
}

std::string json_number(double number)
{
    if (!std::isfinite(number))
    {
        return "null";
    }
    char text[CM_NUMBER_SIZE];
    return std::string(text, cm_number_write_shortest(number, text));
}
