/* SPDX-License-Identifier: MIT
 *
 * The filter of cubemap-latitude: lines of latitudes through a conversion, in constant memory.
 */
#ifndef CUBEMAP_TOOLS_LATITUDE_FILTER_H
#define CUBEMAP_TOOLS_LATITUDE_FILTER_H

#include <stdbool.h>

#include <cubemap/latitude.h>

#include "tools/cli/failure.h"

struct latitude_options
{
    int digits;   /* significant ones to write, 1 to 17 */
    bool radians; /* read and write radians, not degrees */
};

/* Latitudes in degrees from such, n at most BATCH_LINES of line_filter.h, in place; flattening is that of the
 * conversion's ellipsoid. Within 1.5 ulp of 90 degrees; 90, 0 and -90 are exact, and so is everything on a sphere. */
void latitude_degrees(const cm_latitude_conversion *conversion, double flattening, size_t n,
                      double *latitude);

/* Read the input to its end and write the results. What is wrong with a line is told at once, with the
 * input's name; false if any was wrong, or after a failure. */
bool filter_latitudes(const struct latitude_options *options, const cm_ellipsoid *ellipsoid,
                      const cm_latitude_conversion *conversion, const cm_streams *streams,
                      const char *name, cm_failure *failure);

#endif
