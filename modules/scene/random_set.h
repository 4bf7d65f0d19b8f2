/* SPDX-License-Identifier: MIT
 *
 * The loops over random numbers, once for each instruction set; all with the same bits.
 */
#ifndef MODULES_SCENE_RANDOM_SET_H
#define MODULES_SCENE_RANDOM_SET_H

#include <stddef.h>
#include <stdint.h>

/* All of a place but the pixel. */
typedef struct cm_random_place
{
    uint64_t seed;
    uint32_t view;
    uint32_t sample;
} cm_random_place;

typedef struct cm_random_set
{
    const char *name; /* first: as in options.h */
    /* As the arrays of random.h. */
    void (*uniform)(const cm_random_place *of, uint32_t first, size_t n, double *value);
    void (*normal)(const cm_random_place *of, uint32_t first, size_t n, double *value);
    void (*poisson)(const cm_random_place *of, uint32_t first, size_t n, const double *mean,
                    double *count);
} cm_random_set;

extern const cm_random_set cm_random_scalar;
#ifdef CM_HAVE_SSE2
extern const cm_random_set cm_random_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const cm_random_set cm_random_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const cm_random_set cm_random_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const cm_random_set cm_random_neon;
#endif

/* The set of that name, or what the environment or the machine says if it is NULL; NULL if this machine lacks it. */
const cm_random_set *cm_random_set_find(const char *name);

#endif
