// SPDX-License-Identifier: MIT

#include "sequence_folder.hpp"

#include "file_failure.hpp"
#include "trajectory_file.h"
#include "modules/scene/trajectory_data.h"

#include <algorithm>
#include <cstdlib>
#include <map>

namespace
{

// A list of poses that goes away.
struct PoseList : cm_pose_list
{
    PoseList() : cm_pose_list{}
    {
    }
    ~PoseList()
    {
        cm_pose_list_clear(this);
    }
    PoseList(const PoseList &) = delete;
    PoseList &operator=(const PoseList &) = delete;
};

void check_read(cm_status status, const char *message)
{
    if (status != CM_OK)
    {
        throw FileFailure(status, message);
    }
}

// The index of the nearest of rising times, the earlier of two; count if none is within so many seconds.
template <typename TimeAt>
std::size_t nearest_time(std::size_t count, const TimeAt &time_at, double time, double within)
{
    std::size_t low = 0;
    std::size_t high = count;
    while (low < high)
    {
        const std::size_t middle = low + (high - low) / 2;
        (time_at(middle) < time ? low : high) = time_at(middle) < time ? middle + 1 : middle;
    }
    std::size_t best = count;
    for (const std::size_t i : {low - 1, low}) // below 0 is beyond count
    {
        if (i < count && cm_stamps_within(time_at(i), time, within) &&
            (best == count || cm_later_is_nearest(time_at(best), time_at(i), time, within) != 0))
        {
            best = i;
        }
    }
    return best;
}

std::vector<TimedName> read_time_list(const std::string &path)
{
    return parse_time_list(path, read_whole(path, text_bytes_most));
}

// Those that are there; the others are counted.
std::vector<TimedName> present(const std::string &folder, std::vector<TimedName> names,
                               std::size_t &absent)
{
    const auto is_absent = [&folder](const TimedName &each)
    { return !file_is_there(path_in(folder, each.name)); };
    const auto end = std::remove_if(names.begin(), names.end(), is_absent);
    absent = static_cast<std::size_t>(names.end() - end);
    names.erase(end, names.end());
    return names;
}

// In TUM's layout, where colours alone are looked at in place of a list that is not there.
bool has_depth_list(const std::string &folder, const cm_sequence_options &options)
{
    return options.colors_will_do == 0 || file_is_there(path_in(folder, "depth.txt")) ||
           !file_is_there(path_in(folder, "rgb.txt"));
}

std::vector<SequenceItem> list_tum(const std::string &folder, const cm_sequence_options &options,
                                   cm_sequence_report &report)
{
    const std::string color_list = path_in(folder, "rgb.txt");
    const bool has_depth = has_depth_list(folder, options);
    const std::vector<TimedName> listed =
        read_time_list(has_depth ? path_in(folder, "depth.txt") : color_list);
    report.listed = listed.size();
    // a mask that is missing is not left out: without it a hull is another
    const std::vector<TimedName> depths =
        has_depth ? present(folder, listed, report.absent) : listed;
    std::vector<TimedName> colors;
    if (has_depth && file_is_there(color_list))
    {
        colors = present(folder, read_time_list(color_list), report.color_absent);
    }
    PoseList poses;
    char message[CM_IMAGE_MESSAGE] = "";
    const std::string truth = path_in(folder, "groundtruth.txt");
    check_read(cm_trajectory_file_read(truth.c_str(), &poses, message), message);
    report.poses = poses.count;
    std::vector<SequenceItem> items;
    for (const TimedName &depth : depths)
    {
        const std::size_t pose = nearest_time(
            poses.count, [&poses](std::size_t i) { return poses.time[i]; }, depth.time,
            options.pose_within);
        if (pose == poses.count)
        {
            ++report.without_pose;
            continue;
        }
        const std::size_t color = nearest_time(
            colors.size(), [&colors](std::size_t i) { return colors[i].time; }, depth.time,
            options.color_within);
        if (has_depth)
        {
            items.push_back({depth.time, poses.pose[pose], depth.name,
                             color == colors.size() ? "" : colors[color].name});
        }
        else
        {
            items.push_back({depth.time, poses.pose[pose], "", depth.name});
        }
    }
    return items;
}

std::string first_present(const std::string &folder, std::initializer_list<std::string> names)
{
    for (const std::string &name : names)
    {
        if (file_is_there(path_in(folder, name)))
        {
            return name;
        }
    }
    return "";
}

std::string numbered_depth(const std::string &folder, std::size_t number)
{
    return first_present(folder, {numbered("depth_", number, 5, ".png"),
                                  numbered("depth_", number, 5, ".npy"),
                                  numbered("depth_", number, 5, ".exr")});
}

std::vector<SequenceItem> list_open3d(const std::string &folder, const cm_sequence_options &options,
                                      cm_sequence_report &report)
{
    PoseList poses;
    char message[CM_IMAGE_MESSAGE] = "";
    const std::string log = path_in(folder, "trajectory.log");
    check_read(cm_trajectory_log_read(log.c_str(), &poses, message), message);
    report.poses = poses.count;
    std::vector<SequenceItem> items;
    for (std::size_t i = 0; i < poses.count; ++i)
    {
        const std::string depth = numbered_depth(folder, i);
        const std::string color = first_present(
            folder, {numbered("image_", i, 5, ".jpg"), numbered("image_", i, 5, ".png")});
        if (depth.empty() && (options.colors_will_do == 0 || color.empty()))
        {
            ++report.absent;
            continue;
        }
        items.push_back({static_cast<double>(i) / numbered_rate, poses.pose[i], depth, color});
    }
    // of a log that was cut off
    while (!numbered_depth(folder, poses.count + report.without_pose).empty())
    {
        ++report.without_pose;
    }
    report.listed = poses.count + report.without_pose;
    return items;
}

// Which of the files frame-NNNNNN.KIND there are, by N.
struct FrameFiles
{
    bool depth = false;
    bool pose = false;
};

std::map<std::size_t, FrameFiles> frame_files(const std::string &folder)
{
    std::map<std::size_t, FrameFiles> found;
    for (const std::string &name : names_in_folder(folder))
    {
        if (name.size() < 13 || name.compare(0, 6, "frame-") != 0 ||
            name.find_first_not_of("0123456789", 6) != 12 || name[12] != '.')
        {
            continue;
        }
        FrameFiles &files = found[std::strtoul(name.substr(6, 6).c_str(), nullptr, 10)];
        const std::string kind = name.substr(13);
        files.depth = files.depth || kind == "depth.png";
        files.pose = files.pose || kind == "pose.txt";
    }
    return found;
}

std::vector<SequenceItem> list_seven_scenes(const std::string &folder,
                                            const cm_sequence_options &options,
                                            cm_sequence_report &report)
{
    std::vector<SequenceItem> items;
    for (const auto &[number, files] : frame_files(folder))
    {
        report.poses += files.pose;
        ++report.listed;
        const std::string color =
            first_present(folder, {numbered("frame-", number, 6, ".color.png"),
                                   numbered("frame-", number, 6, ".color.jpg")});
        const bool is_there = files.depth || (options.colors_will_do != 0 && !color.empty());
        if (!is_there || !files.pose)
        {
            ++(is_there ? report.without_pose : report.absent);
            continue;
        }
        const std::string path = path_in(folder, numbered("frame-", number, 6, ".pose.txt"));
        const std::string text = read_whole(path, 65536);
        SequenceItem item;
        char message[CM_IMAGE_MESSAGE] = "";
        check_read(cm_pose_file_parse(path.c_str(), text.data(), text.size(), &item.pose, message),
                   message);
        item.time = static_cast<double>(number) / numbered_rate;
        item.depth = files.depth ? numbered("frame-", number, 6, ".depth.png") : "";
        item.color = color;
        items.push_back(item);
    }
    return items;
}

} // namespace

std::vector<TimedName> parse_time_list(const std::string &name, std::string_view text)
{
    LineWords lines(name, text);
    std::vector<TimedName> names;
    while (lines.next())
    {
        if (lines.words().size() != 2)
        {
            lines.fail("a line is a time and a file; here are " +
                       std::to_string(lines.words().size()) + " words");
        }
        const double time = lines.number(0);
        if (!names.empty() && time <= names.back().time)
        {
            lines.fail("the time " + number_text(time) + " is not after the one before, " +
                       number_text(names.back().time));
        }
        if (lines.words()[1].find('\0') != std::string_view::npos)
        {
            lines.fail("a name with a zero byte");
        }
        names.push_back({time, std::string(lines.words()[1])});
    }
    return names;
}

cm_sequence_layout layout_of(const std::string &folder, const cm_sequence_options &options)
{
    if (!folder_is_there(folder))
    {
        fail_file(folder, "is no folder", CM_ERROR_FILE);
    }
    if (file_is_there(path_in(folder, "depth.txt")))
    {
        return CM_SEQUENCE_TUM;
    }
    if (file_is_there(path_in(folder, "trajectory.log")))
    {
        return CM_SEQUENCE_OPEN3D;
    }
    if (!frame_files(folder).empty())
    {
        return CM_SEQUENCE_SEVEN_SCENES;
    }
    if (!has_depth_list(folder, options))
    {
        return CM_SEQUENCE_TUM;
    }
    fail_file(folder, std::string("is no sequence: it has neither depth.txt nor ") +
                          (options.colors_will_do != 0 ? "rgb.txt nor " : "") +
                          "trajectory.log nor frame-NNNNNN.depth.png");
}

std::vector<SequenceItem> list_views(const std::string &folder, const cm_sequence_options &options,
                                     cm_sequence_report &report)
{
    std::vector<SequenceItem> items =
        report.layout == CM_SEQUENCE_TUM      ? list_tum(folder, options, report)
        : report.layout == CM_SEQUENCE_OPEN3D ? list_open3d(folder, options, report)
                                              : list_seven_scenes(folder, options, report);
    if (items.empty())
    {
        fail_file(folder,
                  "has no view: of " + std::to_string(report.listed) +
                      (options.colors_will_do != 0 ? " images " : " depth images ") +
                      std::to_string(report.absent) + " are absent and " +
                      std::to_string(report.without_pose) + " have no pose",
                  CM_ERROR_FILE);
    }
    report.count = items.size();
    report.first = items.front().time;
    report.last = items.back().time;
    for (const SequenceItem &item : items)
    {
        report.without_color += item.color.empty();
    }
    return items;
}

std::string numbered(const char *begin, std::size_t number, std::size_t digits, const char *end)
{
    std::string text = std::to_string(number);
    text.insert(0, digits > text.size() ? digits - text.size() : 0, '0');
    return begin + text + end;
}
