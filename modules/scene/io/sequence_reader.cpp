// SPDX-License-Identifier: MIT

#include "sequence.h"

#include "camera_file.h"
#include "file_failure.hpp"
#include "picture_file.hpp"
#include "sequence_folder.hpp"
#include "view_stream.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

namespace
{

constexpr double usual_within = 0.02; // seconds, as TUM's tools have it

std::size_t read_input(void *, void *bytes, std::size_t count)
{
    return std::fread(bytes, 1, count, stdin);
}

} // namespace

struct cm_sequence
{
    cm_sequence(const std::string &name, const cm_sequence_options &options);
    const cm_view *view_at(std::size_t k);
    void describe_entry(std::size_t k, cm_sequence_entry &entry) const;

    cm_sequence_report report = {};
    bool is_stream() const
    {
        return reader != nullptr;
    }

private:
    void open_folder(const cm_sequence_options &options);
    void open_camera(const char *given);
    void open_stream();
    const cm_view *next_of_stream(std::size_t k);
    void check_index(std::size_t k) const;

    std::string folder;
    CameraPointer camera;
    std::vector<SequenceItem> items;
    OwnPicture depth;
    OwnPicture color;
    cm_view view = {};
    std::unique_ptr<cm_view_reader, decltype(&cm_view_reader_destroy)> reader{
        nullptr, cm_view_reader_destroy};
};

cm_sequence::cm_sequence(const std::string &name, const cm_sequence_options &options) : folder(name)
{
    report.size = sizeof report;
    if (name == "-" || options.layout == CM_SEQUENCE_STREAM)
    {
        open_stream();
    }
    else
    {
        open_folder(options);
    }
}

void cm_sequence::open_stream()
{
    const cm_image_stream stream = {nullptr, read_input, nullptr, nullptr, nullptr};
    char message[CM_IMAGE_MESSAGE] = "";
    cm_view_reader *made = nullptr;
    const cm_status status = cm_view_reader_create("standard input", &stream, &made, message);
    if (status != CM_OK)
    {
        throw FileFailure(status, message);
    }
    reader.reset(made);
    report.layout = CM_SEQUENCE_STREAM;
    report.camera = cm_view_reader_camera(made, &report.depth_scale);
}

void cm_sequence::open_camera(const char *given)
{
    const std::string own = path_in(folder, "camera.json");
    if (given == nullptr && !file_is_there(own))
    {
        fail_file(folder, "has no camera.json, and no other camera is given", CM_ERROR_CAMERA);
    }
    cm_camera *made = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    const char *const path = given != nullptr ? given : own.c_str();
    const cm_status status = cm_camera_file_read(path, &made, &report.depth_scale, message);
    if (status != CM_OK)
    {
        throw FileFailure(status, message);
    }
    camera.reset(made);
    report.camera = made;
}

void cm_sequence::open_folder(const cm_sequence_options &options)
{
    report.layout = options.layout == CM_SEQUENCE_ANY ? layout_of(folder, options) : options.layout;
    if (!folder_is_there(folder))
    {
        fail_file(folder, "is no folder", CM_ERROR_FILE);
    }
    open_camera(options.camera);
    items = list_views(folder, options, report);
}

void cm_sequence::check_index(std::size_t k) const
{
    if (k >= items.size())
    {
        throw FileFailure(CM_ERROR_RANGE, folder + ": has no view " + std::to_string(k) +
                                              "; it has " + std::to_string(items.size()) +
                                              ", from 0");
    }
}

void cm_sequence::describe_entry(std::size_t k, cm_sequence_entry &entry) const
{
    if (is_stream())
    {
        throw FileFailure(CM_ERROR_UNSUPPORTED, "a stream's views are known when they are read");
    }
    check_index(k);
    const SequenceItem &item = items[k];
    entry = {item.time, item.pose, item.depth.empty() ? nullptr : item.depth.c_str(),
             item.color.empty() ? nullptr : item.color.c_str()};
}

const cm_view *cm_sequence::next_of_stream(std::size_t k)
{
    if (k != report.count)
    {
        throw FileFailure(CM_ERROR_RANGE, "the views of a stream come once, in their order");
    }
    const cm_view *next = nullptr;
    char message[CM_IMAGE_MESSAGE] = "";
    const cm_status status = cm_view_reader_next(reader.get(), &next, message);
    if (status != CM_OK)
    {
        throw FileFailure(status, message);
    }
    report.first = report.count == 0 ? next->time : report.first;
    report.last = next->time;
    report.without_color += next->color.data == nullptr;
    report.listed = report.poses = ++report.count;
    return next;
}

const cm_view *cm_sequence::view_at(std::size_t k)
{
    if (is_stream())
    {
        return next_of_stream(k);
    }
    check_index(k);
    const SequenceItem &item = items[k];
    const cm_camera_options &options = *cm_camera_describe(camera.get());
    depth.clear();
    if (!item.depth.empty())
    {
        read_depth(path_in(folder, item.depth), options, depth);
    }
    if (report.layout == CM_SEQUENCE_SEVEN_SCENES && !item.depth.empty() &&
        depth.image.type == CM_PIXEL_U16)
    {
        for (std::size_t i = 0; i < depth.bytes.size(); i += 2)
        {
            std::uint16_t value;
            std::memcpy(&value, &depth.bytes[i], sizeof value);
            value = value == seven_scenes_none ? 0 : value;
            std::memcpy(&depth.bytes[i], &value, sizeof value);
        }
    }
    color.clear();
    if (!item.color.empty())
    {
        read_color(path_in(folder, item.color), options, color);
    }
    view = {};
    view.size = sizeof view;
    view.time = item.time;
    view.camera = camera.get();
    view.pose = item.pose;
    view.depth = depth.image;
    view.depth_is_range = options.mapping != nullptr;
    view.depth_unit = 1.0 / report.depth_scale;
    view.color = color.image;
    view.amplitude.size = sizeof view.amplitude;
    return &view;
}

namespace
{

const std::array<const char *, 5> layout_names = {nullptr, "tum", "open3d", "7scenes", "stream"};

// C lets any number pass for a layout.
std::uint32_t layout_number(const cm_sequence_layout &layout)
{
    std::uint32_t number = 0;
    static_assert(sizeof number == sizeof layout);
    std::memcpy(&number, &layout, sizeof number);
    return number;
}

bool is_layout_or_any(const cm_sequence_layout &layout)
{
    return layout_number(layout) < layout_names.size();
}

} // namespace

const char *cm_sequence_layout_name(cm_sequence_layout layout)
{
    const std::uint32_t number = layout_number(layout);
    return number < layout_names.size() ? layout_names[number] : nullptr;
}

cm_status cm_sequence_layout_find(const char *name, cm_sequence_layout *layout)
{
    for (std::size_t i = 1; i < layout_names.size() && name != nullptr && layout != nullptr; ++i)
    {
        if (std::strcmp(name, layout_names[i]) == 0)
        {
            *layout = static_cast<cm_sequence_layout>(i);
            return CM_OK;
        }
    }
    return CM_ERROR_ARGUMENT;
}

cm_status cm_sequence_open(const char *folder, const cm_sequence_options *options,
                           cm_sequence **sequence, char *message)
{
    cm_sequence_options wanted = {};
    wanted.size = sizeof wanted;
    if (folder == nullptr || sequence == nullptr ||
        (options != nullptr && options->size != sizeof *options))
    {
        return CM_ERROR_ARGUMENT;
    }
    wanted = options != nullptr ? *options : wanted;
    wanted.pose_within = wanted.pose_within == 0.0 ? usual_within : wanted.pose_within;
    wanted.color_within = wanted.color_within == 0.0 ? usual_within : wanted.color_within;
    if (!is_layout_or_any(wanted.layout) || !(wanted.pose_within > 0.0) ||
        !(wanted.color_within > 0.0))
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { *sequence = new cm_sequence(folder, wanted); });
}

void cm_sequence_close(cm_sequence *sequence)
{
    delete sequence;
}

size_t cm_sequence_count(const cm_sequence *sequence)
{
    return sequence->is_stream() ? CM_SEQUENCE_UNKNOWN : sequence->report.count;
}

const cm_sequence_report *cm_sequence_describe(const cm_sequence *sequence)
{
    return &sequence->report;
}

cm_status cm_sequence_entry_at(const cm_sequence *sequence, size_t k, cm_sequence_entry *entry,
                               char *message)
{
    if (sequence == nullptr || entry == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { sequence->describe_entry(k, *entry); });
}

cm_status cm_sequence_view(cm_sequence *sequence, size_t k, const cm_view **view, char *message)
{
    if (sequence == nullptr || view == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { *view = sequence->view_at(k); });
}
