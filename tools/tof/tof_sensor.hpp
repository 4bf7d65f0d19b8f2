// SPDX-License-Identifier: MIT
//
// SENSOR.json: a time-of-flight camera with its lights, from a file or from what is built in.

#ifndef CUBEMAP_TOOLS_TOF_SENSOR_HPP
#define CUBEMAP_TOOLS_TOF_SENSOR_HPP

#include "modules/scene/io/parsed_json.hpp"
#include "tools/cli/scene_handle.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <cubemap/sim.h>

// What cm_tof_simulate takes, with all that it points to.
struct TofSensor
{
    std::string name;                        // for messages
    JsonPointer text{nullptr, cJSON_Delete}; // as it was given
    CameraPointer camera;
    std::vector<float> mask;
    std::vector<double> harmonic;
    std::vector<double> shot_variance;
    std::size_t shot_line = 0;                 // where that stands
    std::vector<std::vector<float>> intensity; // one for each light
    cm_tof_sensor sensor = {};
    std::vector<cm_tof_light> light;
};

// Failure, "FILE:LINE: what is wrong". What the numbers mean together is not asked here.
TofSensor parse_tof_sensor(const std::string &name, std::string_view text);
TofSensor read_tof_sensor(const std::string &path);

// One that is built in; UsageFailure if there is none of that name.
TofSensor tof_preset(const std::string &name);

#endif
