// SPDX-License-Identifier: MIT

#include "trajectory_file.h"

#include "file_failure.hpp"
#include "pose_words.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace
{

struct PoseArrays
{
    std::vector<double> time;
    std::vector<cm_pose> pose;
};

template <typename Value> Value *copy_of(const std::vector<Value> &values)
{
    Value *const copy = static_cast<Value *>(std::malloc(values.size() * sizeof(Value)));
    if (copy == nullptr)
    {
        throw std::bad_alloc();
    }
    std::memcpy(copy, values.data(), values.size() * sizeof(Value));
    return copy;
}

void give_poses(const PoseArrays &arrays, cm_pose_list *list)
{
    std::unique_ptr<double, decltype(&std::free)> time(nullptr, std::free);
    if (!arrays.time.empty())
    {
        time.reset(copy_of(arrays.time));
    }
    list->pose = copy_of(arrays.pose);
    list->time = time.release();
    list->count = arrays.pose.size();
}

PoseArrays parse_lines(const char *name, std::string_view text)
{
    LineWords lines(name, text);
    PoseArrays arrays;
    while (lines.next())
    {
        if (lines.words().size() != 8)
        {
            lines.fail("a pose is 8 numbers, time tx ty tz qx qy qz qw; here are " +
                       std::to_string(lines.words().size()));
        }
        const double time = lines.number(0);
        if (!arrays.time.empty() && time <= arrays.time.back())
        {
            lines.fail("the time " + number_text(time) + " is not after the one before, " +
                       number_text(arrays.time.back()));
        }
        const std::array<double, 3> position = {lines.number(1), lines.number(2), lines.number(3)};
        const std::array<double, 4> quaternion = {lines.number(4), lines.number(5), lines.number(6),
                                                  lines.number(7)};
        cm_pose pose;
        if (cm_pose_from_quaternion(position.data(), quaternion.data(), &pose) != CM_OK)
        {
            lines.fail("the quaternion's length is more than 0.001 off 1", CM_ERROR_CAMERA);
        }
        arrays.time.push_back(time);
        arrays.pose.push_back(pose);
    }
    if (arrays.pose.empty())
    {
        fail_file(name, "has no pose");
    }
    return arrays;
}

// Four lines of a matrix from camera to world, the first of which is the current one.
cm_pose take_matrix(const char *name, LineWords &lines)
{
    std::array<std::array<double, 4>, 4> matrix;
    for (std::size_t row = 0; row < 4; ++row)
    {
        if (row > 0 && !lines.next())
        {
            fail_line(name, lines.line(), "a matrix ends behind " + std::to_string(row) + " rows");
        }
        if (lines.words().size() != 4)
        {
            lines.fail("a matrix has 4 numbers a row; here are " +
                       std::to_string(lines.words().size()));
        }
        for (std::size_t column = 0; column < 4; ++column)
        {
            matrix[row][column] = lines.number(column);
        }
    }
    cm_pose pose;
    if (!pose_of_matrix(matrix, pose))
    {
        lines.fail("a matrix that is no pose: its rows are no rotation, or its last is not 0 0 0 1",
                   CM_ERROR_CAMERA);
    }
    return pose;
}

PoseArrays parse_log(const char *name, std::string_view text)
{
    LineWords lines(name, text);
    PoseArrays arrays;
    while (lines.next())
    {
        if (lines.words().size() != 3)
        {
            lines.fail("an entry begins with 3 numbers; here are " +
                       std::to_string(lines.words().size()));
        }
        for (std::size_t i = 0; i < 3; ++i)
        {
            lines.number(i);
        }
        if (!lines.next())
        {
            fail_line(name, lines.line(), "an entry without its matrix");
        }
        arrays.pose.push_back(take_matrix(name, lines));
    }
    if (arrays.pose.empty())
    {
        fail_file(name, "has no pose");
    }
    return arrays;
}

} // namespace

void cm_pose_list_clear(cm_pose_list *list)
{
    if (list != nullptr)
    {
        std::free(list->time);
        std::free(list->pose);
        *list = {};
    }
}

cm_status cm_trajectory_file_parse(const char *name, const char *text, size_t length,
                                   cm_pose_list *list, char *message)
{
    if (name == nullptr || text == nullptr || list == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { give_poses(parse_lines(name, {text, length}), list); });
}

cm_status cm_trajectory_file_read(const char *path, cm_pose_list *list, char *message)
{
    if (path == nullptr || list == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(
        message, [&] { give_poses(parse_lines(path, read_whole(path, text_bytes_most)), list); });
}

cm_status cm_trajectory_log_parse(const char *name, const char *text, size_t length,
                                  cm_pose_list *list, char *message)
{
    if (name == nullptr || text == nullptr || list == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&] { give_poses(parse_log(name, {text, length}), list); });
}

cm_status cm_trajectory_log_read(const char *path, cm_pose_list *list, char *message)
{
    if (path == nullptr || list == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message, [&]
                        { give_poses(parse_log(path, read_whole(path, text_bytes_most)), list); });
}

cm_status cm_pose_file_parse(const char *name, const char *text, size_t length, cm_pose *pose,
                             char *message)
{
    if (name == nullptr || text == nullptr || pose == nullptr)
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message,
                        [&]
                        {
                            LineWords lines(name, {text, length});
                            if (!lines.next())
                            {
                                fail_file(name, "has no pose");
                            }
                            const cm_pose found = take_matrix(name, lines);
                            if (lines.next())
                            {
                                lines.fail("more than one pose");
                            }
                            *pose = found;
                        });
}

cm_status cm_trajectory_file_write(const char *path, size_t count, const double *time,
                                   const cm_pose *pose, char *message)
{
    if (path == nullptr || (count > 0 && (time == nullptr || pose == nullptr)))
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message,
                        [&]
                        {
                            std::string text = "# timestamp tx ty tz qx qy qz qw\n";
                            for (std::size_t i = 0; i < count; ++i)
                            {
                                text += pose_line(time[i], pose[i]);
                            }
                            write_whole(path, text);
                        });
}

cm_status cm_trajectory_log_write(const char *path, size_t count, const cm_pose *pose,
                                  char *message)
{
    if (path == nullptr || (count > 0 && pose == nullptr))
    {
        return CM_ERROR_ARGUMENT;
    }
    return guarded_file(message,
                        [&]
                        {
                            std::string text;
                            for (std::size_t i = 0; i < count; ++i)
                            {
                                const std::string number = std::to_string(i);
                                text += number + " " + number + " " + std::to_string(i + 1) + "\n" +
                                        matrix_lines(pose[i]);
                            }
                            write_whole(path, text);
                        });
}
