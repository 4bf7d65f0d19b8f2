/* SPDX-License-Identifier: MIT
 *
 * Random numbers that are counted, not drawn: a number is a function of seed, view, pixel and sample, so that it is the same
 * for any order of work and any threads. Of the library cubemap-scene.
 *
 *   generator Philox 4x32-10 (Salmon, Moraes, Dror and Shaw 2011). The seed is its key, least half first; pixel, sample,
 *             view and block are its counter
 *   bits      the same of every compiler, instruction set and number of threads: only operations that IEEE 754 rounds
 *             correctly are used, and of the C library nothing that may round otherwise
 *   pixels    arrays are of the pixels from one on; the pixel behind 2^32 - 1 is 0
 *   kinds     uniform, normal and Poisson numbers of the same place are independent of each other
 */
#ifndef CUBEMAP_RANDOM_H
#define CUBEMAP_RANDOM_H

#include <stddef.h>
#include <stdint.h>

#include <cubemap/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Four words of the generator as it is. The functions below use blocks from 2^28 on. */
CM_API void cm_random_block(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample,
                            uint32_t block, uint32_t words[4]);

/* In (0, 1): odd multiples of 2^-53, each with the same probability. */
CM_API double cm_random_uniform(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample);

/* Of mean 0 and standard deviation 1: the inverse of the distribution function (Wichura 1988, AS 241) at a number as
 * cm_random_uniform gives them; in (-8.3, 8.3). */
CM_API double cm_random_normal(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample);

/* A count of Poisson's distribution itself, not of a normal one like it: below a mean of 10 by inversion of one uniform
 * number, from there on by rejection (Hoermann 1993, PTRS). A whole number as far as doubles hold them; NaN if the mean is not finite or less
 * than 0. */
CM_API double cm_random_poisson(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample,
                                double mean);

/* The same of the pixels from first on, n of them. count may be mean. */
CM_API void cm_random_uniform_array(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample,
                                    size_t n, double *value);
CM_API void cm_random_normal_array(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample,
                                   size_t n, double *value);
CM_API void cm_random_poisson_array(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample,
                                    size_t n, const double *mean, double *count);

#ifdef __cplusplus
}
#endif

#endif
