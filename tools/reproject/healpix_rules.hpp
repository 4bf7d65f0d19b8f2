// SPDX-License-Identifier: MIT
//
// FITS files that are written are maps of HEALPix, in one of its two orders.

#ifndef CUBEMAP_TOOLS_HEALPIX_RULES_HPP
#define CUBEMAP_TOOLS_HEALPIX_RULES_HPP

#include "reproject_options.hpp"
#include "tools/cli/image_format.hpp"

#include <string>

// Does the name end as those of FITS files do?
bool is_fits_name(const std::string &path);

// OUTPUT as its format wants it, as far as the command line does not say it. UsageFailure if it says what such a file
// cannot be.
void take_healpix_rules(Options &options);

// A plan for such a file: floats, in the order of the command line.
void plan_healpix(ImagePlan &plan, const Options &options);

#endif
