// SPDX-License-Identifier: MIT
//
// Charts of what cubemap-tof has found: as JSON, which tof-chart draws where Python has matplotlib.

#ifndef CUBEMAP_TOOLS_TOF_CHART_HPP
#define CUBEMAP_TOOLS_TOF_CHART_HPP

#include <string>
#include <vector>

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

// A string of JSON, and the list of charts.
std::string json_text(const std::string &text);
std::string charts_json(const std::vector<Chart> &charts);

// Has a file with "charts" been drawn into the folder? Not where Python or its matplotlib is missing.
bool draw_charts(const std::string &json, const std::string &folder);

std::string text_of_number(double value, int digits);

#endif
