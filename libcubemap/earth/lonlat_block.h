/* SPDX-License-Identifier: MIT
 *
 * Longitudes and latitudes to directions and back, block by block.
 */
#ifndef LIBCUBEMAP_EARTH_LONLAT_BLOCK_H
#define LIBCUBEMAP_EARTH_LONLAT_BLOCK_H

#include "libcubemap/batch/batch_set.h"

/* n <= CM_BLOCK longitudes and latitudes to directions of length 1 (NaN for what is none), in arrays that have
 * room for whole vectors; and back from such arrays, whose rest is overwritten. Results may overwrite
 * arguments. */
void cm_block_of_lonlats(const cm_batch_set *set, size_t n, const double *lon, const double *lat,
                         double *x, double *y, double *z);
void cm_block_to_lonlats(const cm_batch_set *set, size_t n, double *x, double *y, double *z,
                         double *lon, double *lat);

#endif
