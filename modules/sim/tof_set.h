/* SPDX-License-Identifier: MIT
 *
 * The loops over rays, once for each instruction set. Arrays have room for whole vectors: n is rounded up to a multiple of
 * TOF_ROOM, and what is there may be any numbers.
 */
#ifndef CUBEMAP_SIM_TOF_SET_H
#define CUBEMAP_SIM_TOF_SET_H

#include "tof_object.h"

#define TOF_ROOM 8
#define TOF_BLOCK 256

/* Rays of a block and what they met so far. */
typedef struct tof_block
{
    double origin[3][TOF_BLOCK];
    double direction[3][TOF_BLOCK];
    double distance[TOF_BLOCK];
    double normal[3][TOF_BLOCK]; /* of length 1, towards the origin */
    double number[TOF_BLOCK];    /* of the solid: ids as doubles; -1 for nothing */
} tof_block;

/* Places that a lamp shines on. */
typedef struct tof_lit
{
    const double *position[3];
    const double *normal[3];
    const double *range;    /* of the camera */
    const double *strength; /* BRDF in each, times what is left of the light; 1/sr */
    double *total;          /* to which is added */
    double *real;           /* waves x stride */
    double *imaginary;
    size_t stride;
} tof_lit;

typedef struct tof_set
{
    const char *name; /* first: as in options.h */
    /* What of the block a solid is nearer to than all before. */
    void (*meet)(const tof_solid *solid, size_t n, tof_block *block);
    /* Light of a lamp of even intensity, once scattered to the camera. */
    void (*light)(const tof_lamp *lamp, const tof_waves *waves, size_t n, const tof_lit *lit);
    /* cos and sin of 2 pi turns. */
    void (*turn)(size_t n, const double *turns, double *cosine, double *sine);
} tof_set;

extern const tof_set cm_tof_scalar;
#ifdef CM_HAVE_SSE2
extern const tof_set cm_tof_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const tof_set cm_tof_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const tof_set cm_tof_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const tof_set cm_tof_neon;
#endif

/* The set of that name, the scalar one if this build has none. */
const tof_set *cm_tof_set_find(const char *name);

#endif
