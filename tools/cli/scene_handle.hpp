// SPDX-License-Identifier: MIT
//
// What programs of depth cameras hold: cameras, trajectories, sequences, pools, as long as they are needed; their
// failures, and what is told of them.

#ifndef CUBEMAP_TOOLS_SCENE_HANDLE_HPP
#define CUBEMAP_TOOLS_SCENE_HANDLE_HPP

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <cubemap/budget.h>
#include <cubemap/pool.h>
#include <cubemap/trajectory.h>

#include "modules/scene/io/sequence.h"
#include "temporary_guard.hpp"

template <auto destroy> struct HandleDeleter
{
    template <typename Handle> void operator()(Handle *owned) const noexcept
    {
        destroy(owned);
    }
};

using CameraPointer = std::unique_ptr<cm_camera, HandleDeleter<cm_camera_destroy>>;
using TrajectoryPointer = std::unique_ptr<cm_trajectory, HandleDeleter<cm_trajectory_destroy>>;
using PoolPointer = std::unique_ptr<cm_pool, HandleDeleter<cm_pool_destroy>>;
using SequencePointer = std::unique_ptr<cm_sequence, HandleDeleter<cm_sequence_close>>;

// A signal that would end the program waits until the folder is complete, or gone again.
struct SequenceWriterDeleter
{
    void operator()(cm_sequence_writer *owned) noexcept
    {
        cm_sequence_drop(owned);
        signals.reset();
    }
    std::unique_ptr<SignalsHeld> signals;
};
using SequenceWriterPointer = std::unique_ptr<cm_sequence_writer, SequenceWriterDeleter>;

// A camera and its units of depth a metre.
struct CameraFile
{
    CameraPointer camera;
    double depth_scale = 0;
};

// A trajectory as a file has it.
struct TimedPoses
{
    std::vector<double> time;
    std::vector<cm_pose> pose;
};

// Failure with the message, unless the status is CM_OK.
void check_scene(cm_status status, const char *message);

CameraFile read_camera(const std::string &path);
TimedPoses read_poses(const std::string &path);
// colors_will_do: its views need have no depth.
SequencePointer open_sequence(const std::string &folder, const std::string &camera,
                              bool colors_will_do = false);
// Calls body for each view, in the order of time: of a stream, whose end is not known before, up to its end.
void for_each_view(cm_sequence *sequence, const std::function<void(const cm_view &)> &body);
SequenceWriterPointer create_sequence(const std::string &folder, cm_sequence_layout layout,
                                      const cm_camera *camera, double depth_scale);
void finish_sequence(const SequenceWriterPointer &writer);

// Threads for a request, 0 for one each core; nothing if it is the calling one alone.
PoolPointer make_pool(int requested);

// NaN of none.
double median_of(std::vector<double> numbers);

// A budget as JSON, on one line.
std::string budget_text(const cm_budget &budget);

// A number of JSON that is the same again; null for what is not finite.
std::string json_number(double number);

#endif
