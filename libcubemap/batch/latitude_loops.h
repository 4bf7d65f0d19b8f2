/* SPDX-License-Identifier: MIT
 *
 * What latitude_loops.inc makes.
 */
#ifndef LIBCUBEMAP_BATCH_LATITUDE_LOOPS_H
#define LIBCUBEMAP_BATCH_LATITUDE_LOOPS_H

#include <cubemap/kernels.h>

#include <stddef.h>

/* How the loops of latitude_loops.inc convert: by series of so many terms at most, or by a ratio of tangents that is
 * near 1 or is not. */
typedef enum cm_latitude_way
{
    CM_LATITUDE_SERIES_3,
    CM_LATITUDE_SERIES_6,
    CM_LATITUDE_SERIES_12,
    CM_LATITUDE_TANGENT_NEAR,
    CM_LATITUDE_TANGENT_FAR,
    CM_LATITUDE_WAYS
} cm_latitude_way;

/* The loops over whole vectors; angles and directions that are none become NaN. By way. */
typedef struct cm_latitude_loops
{
    void (*angles[CM_LATITUDE_WAYS])(const cm_latitude_constants_f64 *constants, size_t n,
                                     const double *from, double *to);
    void (*directions[CM_LATITUDE_WAYS])(const cm_latitude_constants_f64 *constants, size_t n,
                                         const double *x, const double *y, const double *z,
                                         double *to_x, double *to_y, double *to_z);
} cm_latitude_loops;

#endif
