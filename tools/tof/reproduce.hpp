// SPDX-License-Identifier: MIT
//
// What the papers measured, done again: each experiment gives rows of a table, curves of charts and pictures.

#ifndef CUBEMAP_TOOLS_TOF_REPRODUCE_HPP
#define CUBEMAP_TOOLS_TOF_REPRODUCE_HPP

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

struct ChartCurve
{
    std::string name;
    std::vector<double> x;
    std::vector<double> y;
    std::vector<std::string> mark = {}; // beside each point; none, or as many as points
};

// A picture in false colours; NaN is left white.
struct ChartPicture
{
    std::string name;
    std::string unit;
    std::size_t width = 0;
    std::vector<float> value;
};

struct Chart
{
    std::string name; // of the file
    std::string title;
    std::string x;
    std::string y;
    bool is_scatter = false;
    std::vector<ChartCurve> curves;
    std::vector<ChartPicture> pictures;
    bool is_logarithmic = false;        // both axes
    std::vector<std::string> tick = {}; // what x from 1 on is called, if it is no number
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

std::string text_of_number(double value, int digits);

#endif
