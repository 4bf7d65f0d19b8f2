// SPDX-License-Identifier: MIT
//
// Scenes, a sensor and paths for cubemap-tof: a sphere and a wall whose distances are known.

#ifndef TESTS_PROGRAMS_TOF_INPUTS_HPP
#define TESTS_PROGRAMS_TOF_INPUTS_HPP

#include <string>

constexpr const char *light_text = R"("lights": [{"power": 0.7, "aperture": 6.283185307179586}])";

// Truth is written as parts of an OpenEXR file only where that library is.
#ifdef HAVE_OPENEXR
constexpr const char *truth_in_parts = " --truth";
#else
constexpr const char *truth_in_parts = "";
#endif

// A sensor with something else, or more, at its end.
std::string sensor_text(const std::string &rest = light_text,
                        const std::string &exposure = "\"exposure\": 5e-3");

// A sphere around camera and light, a wall before them, and two poses.
void make_tof_inputs();

#endif
