// SPDX-License-Identifier: MIT
//
// The command line of cubemap-compare.

#ifndef CUBEMAP_TOOLS_COMPARE_OPTIONS_HPP
#define CUBEMAP_TOOLS_COMPARE_OPTIONS_HPP

#include "compare_table.h"
#include "tools/cli/streams.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

struct CompareOptions
{
    std::optional<double> max_mean;
    std::optional<double> max_rmse;
    std::optional<double> max;
    bool quiet = false;
    std::array<bool, MEASURE_COUNT> measure = {}; // is it wanted?
    std::optional<double> peak;                   // in the unit of errors
    bool peak_of_reference = false;
    double pixels_per_degree = 0; // 0: FLIP's standard
    bool by_area = false;
    std::string surface; // specifications; "": not said
    std::string reference_surface;
    unsigned border = 0;
    bool skip_not_finite = false;
    bool json = false;
    unsigned threads = 0;
    std::optional<std::string> difference;
    std::size_t difference_of = DIFFERENCE_ERROR;
    std::optional<std::pair<double, double>> range;
    std::string colors = "uniform-purple-yellow"; // a specification that the library takes
    bool printed = false;                         // is there nothing left to do?
    std::vector<std::string> names;               // of A and B
};

// UsageFailure if the command line is not one.
CompareOptions parse_compare_options(int argc, char **argv, const cm_streams &streams);

#endif
