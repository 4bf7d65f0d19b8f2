/* SPDX-License-Identifier: MIT
 *
 * A mask as <cubemap/orient.h> defines it: the value of the pixel that a direction is in.
 */
#ifndef TESTS_ORIENT_MASK_PIXEL_H
#define TESTS_ORIENT_MASK_PIXEL_H

#include <cubemap/cubemap.h>

#include <math.h>

#define PI 3.14159265358979324

static inline double pixel_at(const cm_mask *mask, const double d[3])
{
    const double lon = atan2(d[1], d[0]);
    const double lat = atan2(d[2], hypot(d[0], d[1]));
    const double column = floor((lon / (2.0 * PI) + 0.5) * (double)mask->width);
    const double row = floor((0.5 - lat / PI) * (double)mask->height);
    const size_t x = (size_t)fmin(fmax(column, 0.0), (double)mask->width - 1.0);
    const size_t y = (size_t)fmin(fmax(row, 0.0), (double)mask->height - 1.0);
    return (double)mask->value[y * mask->width + x];
}

#endif
