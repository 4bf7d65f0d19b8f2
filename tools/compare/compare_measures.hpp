// SPDX-License-Identifier: MIT
//
// What is measured between two pictures.

#ifndef CUBEMAP_TOOLS_COMPARE_MEASURES_HPP
#define CUBEMAP_TOOLS_COMPARE_MEASURES_HPP

#include "compare_options.hpp"
#include "compare_pictures.hpp"

#include <cubemap/compare.h>

#include <optional>

struct Measured
{
    cm_error_figures errors = {};              // always
    std::optional<cm_error_figures> by_area;   // WS-PSNR
    std::optional<cm_error_figures> at_points; // S-PSNR
    std::optional<cm_map_figures> ssim;
    std::optional<cm_map_figures> flip;
    std::optional<cm_map_figures> hdr_flip;
};

// Failure if a measure does not suit the pictures. What is not asked for stays empty.
Measured measure(const CompareOptions &options, Pictures &pictures);

// One number a pixel, as --difference-of says. *highest is the greatest one; NaN if there is none.
std::vector<float> difference_map(const CompareOptions &options, Pictures &pictures,
                                  double *highest);

#endif
