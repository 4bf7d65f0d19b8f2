// SPDX-License-Identifier: MIT
//
// What a folder of a sequence lists, in each layout.

#ifndef CUBEMAP_MODULES_SCENE_SEQUENCE_FOLDER_HPP
#define CUBEMAP_MODULES_SCENE_SEQUENCE_FOLDER_HPP

#include "sequence.h"

#include <string>
#include <string_view>
#include <vector>

struct SequenceItem
{
    double time = 0.0;
    cm_pose pose = {};
    std::string depth; // within the folder; "": none, where colours will do
    std::string color; // "": none
};

// Times of pictures by their names.
struct TimedName
{
    double time = 0.0;
    std::string name;
};

// A list as TUM's depth.txt: "time file". FileFailure for times that do not rise, which name the line.
std::vector<TimedName> parse_time_list(const std::string &name, std::string_view text);

// The layout that a folder has. FileFailure if it has none.
cm_sequence_layout layout_of(const std::string &folder, const cm_sequence_options &options);

// Its views in time; report's counts are filled. FileFailure if there is none.
std::vector<SequenceItem> list_views(const std::string &folder, const cm_sequence_options &options,
                                     cm_sequence_report &report);

// "image_00012.png" and the like: N with at least so many digits.
std::string numbered(const char *begin, std::size_t number, std::size_t digits, const char *end);

// The pictures of Open3D and 7-Scenes come at 30 Hz.
constexpr double numbered_rate = 30.0;
// What 7-Scenes stores where nothing was measured.
constexpr std::uint16_t seven_scenes_none = 65535;

#endif
