/* SPDX-License-Identifier: MIT
 *
 * HEALPix's rings in whole numbers, for what has one pixel at a time.
 */
#ifndef LIBCUBEMAP_BATCH_HEALPIX_RINGS_H
#define LIBCUBEMAP_BATCH_HEALPIX_RINGS_H

#include <math.h>
#include <stdint.h>

/* How many pixels are before ring i of the northern cap, which has 4 i. */
static inline int64_t cm_pixels_before_ring(int64_t i)
{
    return 2 * i * (i - 1);
}

/* The ring of a pixel there: the root is right but for rounding. */
static inline int64_t cm_ring_in_cap(int64_t pixel)
{
    int64_t i = (int64_t)(0.5 + sqrt(0.25 + 0.5 * (double)pixel));
    i -= cm_pixels_before_ring(i) > pixel;
    return i + (cm_pixels_before_ring(i + 1) <= pixel);
}

#endif
