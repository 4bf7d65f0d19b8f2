// SPDX-License-Identifier: MIT
//
// metadata.json: what a data set of a time-of-flight camera should say of itself (Nair et al. 2013, section 6).

#ifndef CUBEMAP_TOOLS_TOF_METADATA_HPP
#define CUBEMAP_TOOLS_TOF_METADATA_HPP

#include "tof_options.hpp"
#include "tof_sensor.hpp"

#include <string>

#include <cubemap/world.h>

// Is scattered light that of paths, not of virtual lights?
bool is_traced(const cm_tof_options &options);

// asked is the command line, done what is simulated; budget is JSON, or "".
std::string metadata_text(const SimulateOptions &asked, const cm_tof_options &done,
                          const TofSensor &sensor, const cm_scene *scene, const TimedPoses &poses,
                          const std::string &budget);

#endif
