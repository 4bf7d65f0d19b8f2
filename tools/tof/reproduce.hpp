// SPDX-License-Identifier: MIT
//
// What the papers measured, done again: each experiment gives rows of a table, curves of charts and pictures.

#ifndef CUBEMAP_TOOLS_TOF_REPRODUCE_HPP
#define CUBEMAP_TOOLS_TOF_REPRODUCE_HPP

#include "tof_chart.hpp"

#include <functional>
#include <string>
#include <vector>

// One line of the table: what the paper says, what came out here, and whether that is as it should be.
struct ReproducedRow
{
    std::string what;
    std::string paper;
    std::string ours;
    bool holds = false;
};

struct Reproduction
{
    std::vector<ReproducedRow> rows;
    std::vector<Chart> charts;
    std::string missing = {}; // why nothing was done
};

struct ReproduceSettings
{
    int threads = 1;
    std::function<void(const std::string &)> tell; // progress: what is being done
};

// Names of experiments, and what does them.
struct Experiment
{
    const char *name;
    const char *source; // of the paper
    Reproduction (*run)(const ReproduceSettings &);
};

Reproduction reproduce_exact(const ReproduceSettings &settings);
Reproduction reproduce_layouts(const ReproduceSettings &settings);
Reproduction reproduce_resolution(const ReproduceSettings &settings);
Reproduction reproduce_multipath(const ReproduceSettings &settings);
Reproduction reproduce_lens(const ReproduceSettings &settings);
Reproduction reproduce_motion_compensation(const ReproduceSettings &settings);

#endif
