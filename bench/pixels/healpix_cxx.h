/* SPDX-License-Identifier: MIT
 *
 * healpix_cxx (Gorski, Reinecke et al.), by arrays: what time_pixels.c measures of it.
 */
#ifndef BENCH_PIXELS_HEALPIX_CXX_H
#define BENCH_PIXELS_HEALPIX_CXX_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of the orders RING, 0, and NESTED, 1. */
void healpix_cxx_prepare(int64_t nside);
void healpix_cxx_from_directions(int order, size_t n, double *const direction[3], int64_t *pixel);
void healpix_cxx_from_angles(int order, size_t n, const double *theta, const double *phi,
                             int64_t *pixel);
void healpix_cxx_to_directions(int order, size_t n, const int64_t *pixel, double *const made[3]);
void healpix_cxx_to_angles(int order, size_t n, const int64_t *pixel, double *theta, double *phi);
/* From that order to the other. */
void healpix_cxx_renumber(int order, size_t n, const int64_t *from, int64_t *to);
void healpix_cxx_neighbours(int order, size_t n, const int64_t *pixel, int64_t (*to)[8]);

#ifdef __cplusplus
}
#endif

#endif
