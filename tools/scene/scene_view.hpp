// SPDX-License-Identifier: MIT
//
// What a camera sees of a world from one pose: depth, colours, and all that is true of each pixel.

#ifndef CUBEMAP_TOOLS_SCENE_VIEW_HPP
#define CUBEMAP_TOOLS_SCENE_VIEW_HPP

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <cubemap/camera.h>
#include <cubemap/pose.h>
#include "scene_in_time.hpp"

// How pictures of depth are made.
struct ViewMaking
{
    const SceneInTime *scene = nullptr;
    const cm_camera *camera = nullptr;
    double depth_scale = 5000;   // units a metre
    std::optional<double> noise; // of range, relative
    std::uint64_t seed = 0;
    bool truth = false;
};

// From where, and when.
struct ViewPlace
{
    double time;
    cm_pose pose;
};

// What a truth file has of a pixel, in this order.
constexpr std::array<const char *, 13> truth_channels = {
    "depth",       "range",           "position.x",  "position.y", "position.z",
    "normal.x",    "normal.y",        "normal.z",    "id",         "forward.column",
    "forward.row", "backward.column", "backward.row"};

// The pictures of one view.
struct SceneView
{
    std::vector<std::uint16_t> depth; // range, if the camera has a mapping; 0: nothing measured
    std::vector<std::uint8_t> color;  // three a pixel
    std::vector<float> truth;         // truth_channels a pixel
};

// Of the view of this number, from a place; with truth, the flow to the places of the next view and of the one before,
// which may be nullptr. Rows from first to before end.
void render_rows(const ViewMaking &making, std::uint32_t number, const ViewPlace &place,
                 const ViewPlace *next, const ViewPlace *before, std::uint32_t first,
                 std::uint32_t end, SceneView &view);

// With room for all pixels of the camera.
SceneView empty_view(const ViewMaking &making);

#endif
