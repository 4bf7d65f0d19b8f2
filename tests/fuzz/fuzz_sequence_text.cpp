// SPDX-License-Identifier: MIT
//
// The texts of sequences: the first byte says which, CAMERA.json (c), lines of TUM (t), trajectory.log (l), a pose (p), a
// list of pictures (d). What is wrong is said in one line that begins with the file's name; a camera that is read is the same
// after it was written.

#include "modules/scene/io/camera_file.h"
#include "modules/scene/io/file_failure.hpp"
#include "modules/scene/io/sequence_folder.hpp"
#include "modules/scene/io/trajectory_file.h"

#include "fuzz.h"

#include <cmath>

namespace
{

char message[CM_IMAGE_MESSAGE];

void check_message(cm_status status)
{
    EXPECT(strncmp(message, "file:", 5) == 0 && is_one_line(message), "%d: %s",
           static_cast<int>(status), message);
}

void check_camera(const char *text, size_t size)
{
    cm_camera *camera = nullptr;
    double scale = 0.0;
    const cm_status status = cm_camera_file_parse("file", text, size, &camera, &scale, message);
    if (status != CM_OK)
    {
        EXPECT(camera == nullptr, "touched");
        check_message(status);
        return;
    }
    char *again = nullptr;
    if (cm_camera_file_format(camera, scale, &again, message) == CM_OK)
    {
        cm_camera *same = nullptr;
        double same_scale = 0.0;
        EXPECT(cm_camera_file_parse("file", again, strlen(again), &same, &same_scale, message) ==
                   CM_OK,
               "%s: %s", again, message);
        EXPECT(same_scale == scale &&
                   cm_camera_describe(same)->fx == cm_camera_describe(camera)->fx,
               "%s", again);
        cm_camera_destroy(same);
        free(again);
    }
    cm_camera_destroy(camera);
}

void check_list(cm_status status, cm_pose_list *list)
{
    if (status != CM_OK)
    {
        EXPECT(list->count == 0 && list->pose == nullptr, "touched");
        check_message(status);
        return;
    }
    for (size_t i = 0; i < list->count; ++i)
    {
        EXPECT(cm_pose_check(&list->pose[i]) == CM_OK, "pose %zu", i);
        EXPECT(list->time == nullptr || std::isfinite(list->time[i]), "time %zu", i);
    }
    cm_pose_list_clear(list);
}

void check_pictures(const char *text, size_t size)
{
    try
    {
        for (const TimedName &each : parse_time_list("file", {text, size}))
        {
            EXPECT(std::isfinite(each.time) && !each.name.empty(), "an entry that is none");
        }
    }
    catch (const FileFailure &failure)
    {
        EXPECT(strncmp(failure.what(), "file:", 5) == 0, "%s", failure.what());
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0)
    {
        return 0;
    }
    const char *const text = reinterpret_cast<const char *>(data) + 1;
    cm_pose_list list = {};
    cm_pose pose;
    switch (data[0])
    {
    case 'c':
        check_camera(text, size - 1);
        break;
    case 't':
        check_list(cm_trajectory_file_parse("file", text, size - 1, &list, message), &list);
        break;
    case 'l':
        check_list(cm_trajectory_log_parse("file", text, size - 1, &list, message), &list);
        break;
    case 'p':
        if (cm_pose_file_parse("file", text, size - 1, &pose, message) == CM_OK)
        {
            EXPECT(cm_pose_check(&pose) == CM_OK, "a pose that is none");
        }
        break;
    default:
        check_pictures(text, size - 1);
        break;
    }
    return 0;
}
