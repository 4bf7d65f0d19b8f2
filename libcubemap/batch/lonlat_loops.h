/* SPDX-License-Identifier: MIT
 *
 * What lonlat_loops.inc makes.
 */
#ifndef LIBCUBEMAP_BATCH_LONLAT_LOOPS_H
#define LIBCUBEMAP_BATCH_LONLAT_LOOPS_H

#include <stddef.h>

/* Longitudes and latitudes (lonlat_loops.inc), in double. */
typedef struct cm_lonlat_loops
{
    void (*directions)(size_t n, const double *lon, const double *lat, double *x, double *y,
                       double *z);
    void (*lonlats)(size_t n, const double *x, const double *y, const double *z, double *lon,
                    double *lat);
} cm_lonlat_loops;

/* Longitudes up to here are reduced by vectors, those beyond by the C library. */
#define CM_LONLAT_WHOLE 1.0e6

#endif
