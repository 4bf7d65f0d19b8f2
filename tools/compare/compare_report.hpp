// SPDX-License-Identifier: MIT
//
// What was measured, in words, as JSON, and in colours.

#ifndef CUBEMAP_TOOLS_COMPARE_REPORT_HPP
#define CUBEMAP_TOOLS_COMPARE_REPORT_HPP

#include "compare_measures.hpp"

// A line a measure, or one object of JSON, as the options say.
std::string report(const CompareOptions &options, const Pictures &pictures,
                   const Measured &measured);

// The picture of the difference, which the options ask for.
void draw_difference(const CompareOptions &options, Pictures &pictures);

// Failure if an error is above its limit.
void check_limits(const CompareOptions &options, const Pictures &pictures,
                  const Measured &measured);

#endif
