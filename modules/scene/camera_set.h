/* SPDX-License-Identifier: MIT
 *
 * The loops over rays and pixels of perspective cameras, once for each instruction set. A block is always whole, so that a
 * point has the same bits wherever it stands.
 */
#ifndef MODULES_SCENE_CAMERA_SET_H
#define MODULES_SCENE_CAMERA_SET_H

#include <stdint.h>

#include "camera_lens.h"

#define CM_CAMERA_BLOCK 64

/* A step of so much of a ray is none: beside a pole pixels are so dense that no double has a smaller residual. */
#define CM_CAMERA_STILL 0x1p-49

/* A block on its way: first what is asked, then what is found. */
typedef struct cm_camera_block
{
    double x[CM_CAMERA_BLOCK]; /* a point; a ray */
    double y[CM_CAMERA_BLOCK];
    double z[CM_CAMERA_BLOCK];
    double column[CM_CAMERA_BLOCK]; /* a pixel */
    double row[CM_CAMERA_BLOCK];
    double aim_x
        [CM_CAMERA_BLOCK]; /* of a pixel: in focal lengths, the tilt undone, and what its residual may be */
    double aim_y[CM_CAMERA_BLOCK];
    double slack[CM_CAMERA_BLOCK];
    double mark
        [CM_CAMERA_BLOCK]; /* what is known in the end: 0 outside, 1 inside, 2 the loops cannot tell */
} cm_camera_block;

typedef struct cm_camera_set
{
    const char *name; /* first: as in options.h */
    /* Points to columns and rows; within so much of the axis (the square of a ray's length beside it) the lens's signs
     * alone say whether a ray is inside. The number of open ones. */
    int64_t (*project)(const cm_lens *lens, double within, cm_camera_block *block);
    /* Columns and rows to aims. Those further from the axis than `furthest`, squared, have no ray: their mark is 0, others'
     * 2. */
    void (*aim)(const cm_lens *lens, double furthest, cm_camera_block *block);
    /* Aims to rays. Open ones are NaN, or rays of which the lens makes the aim, but perhaps not inside. */
    int64_t (*rays)(const cm_lens *lens, double within, cm_camera_block *block);
} cm_camera_set;

extern const cm_camera_set cm_camera_scalar;
#ifdef CM_HAVE_SSE2
extern const cm_camera_set cm_camera_sse2;
#endif
#ifdef CM_HAVE_AVX2
extern const cm_camera_set cm_camera_avx2;
#endif
#ifdef CM_HAVE_AVX512
extern const cm_camera_set cm_camera_avx512;
#endif
#ifdef CM_HAVE_NEON
extern const cm_camera_set cm_camera_neon;
#endif

/* The best set that this machine runs, or that of the environment; the scalar one if nothing else is known. */
const cm_camera_set *cm_camera_set_find(void);

#endif
