// SPDX-License-Identifier: MIT
//
// What reading and writing maps of HEALPix in FITS share: numbers for pixels without a value, errors of CFITSIO.

#ifndef CUBEMAP_MODULES_HEALPIX_WORDS_HPP
#define CUBEMAP_MODULES_HEALPIX_WORDS_HPP

#include "image_io.h"

#include <cstdint>
#include <string>

// HEALPix 3.83, "HEALPix Primer", section 4: the value of pixels without one.
inline constexpr float unseen_value = -1.6375e30f;

// Our own key: LON,LAT,ROLL, how the map's axes stand, as the tag cubemap:rotation.
inline constexpr const char *rotation_key = "CUBEROT";

// The list of a map in that order, channels floats a pixel, to the picture of the surface "healpix", or back.
// ImageFailure.
void arrange_map(std::int64_t nside, bool nested, bool to_list, std::size_t channels,
                 const float *from, float *to);

// ImageFailure with what CFITSIO says, if it says something is wrong.
void check_fits(int status, const std::string &what);

#endif
