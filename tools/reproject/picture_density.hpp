// SPDX-License-Identifier: MIT
//
// How many pixels surfaces have for each part of the sphere, and the sizes that come of it.

#ifndef CUBEMAP_TOOLS_PICTURE_DENSITY_HPP
#define CUBEMAP_TOOLS_PICTURE_DENSITY_HPP

#include <cubemap/image.h>

struct PictureDensity
{
    double mean; // pixels of a steradian
    double
        least; // pixels of a radian, in the direction in which there are the fewest: the least such number of all places
    double most; // and the greatest
};

// From places spread over the planes. All 0 if no place is on the sphere.
PictureDensity density_of(const cm_surface &surface);

#endif
