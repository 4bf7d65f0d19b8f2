// SPDX-License-Identifier: MIT
//
// The command line of cubemap-tof simulate.

#ifndef CUBEMAP_TOOLS_TOF_OPTIONS_HPP
#define CUBEMAP_TOOLS_TOF_OPTIONS_HPP

#include "tools/cli/program.hpp"

#include <cstdint>
#include <optional>
#include <string>

#include <cubemap/sim.h>

struct SimulateOptions
{
    std::string scene;
    std::string sensor; // a file; "": the preset
    std::string preset;
    std::string trajectory;
    std::string output;
    std::optional<std::string> environment;         // a file
    std::optional<std::string> environment_surface; // else equirect
    cm_tof_options tof = {};
    bool bounces_given = false;
    bool samples_given = false;
    std::optional<double> budget; // metres
    bool truth = false;
    int format = -1;        // TOF_FORMAT_EXR and so on; -1: as output asks
    bool is_stream = false; // to standard output
    bool json = false;
    bool quiet = false;
    int threads = 0;
    bool printed = false; // nothing else is to be done
};

SimulateOptions parse_simulate_options(int argc, char **argv, const cm_streams &streams);

// Metres of "1mm", "0.5cm", "0.001"; nothing if it is none, or not above 0.
std::optional<double> read_length(const std::string &text);

#endif
