/* SPDX-License-Identifier: MIT
 *
 * All loops of an instruction set as one table of tables.
 */
#ifndef LIBCUBEMAP_BATCH_BATCH_SET_H
#define LIBCUBEMAP_BATCH_BATCH_SET_H

#include "cell_loops.h"
#include "healpix_loops.h"
#include "latitude_loops.h"
#include "lonlat_loops.h"
#include "mapping_loops.h"
#include "orient_loops.h"
#include "part_loops.h"

/* what distortion.h has for a point */
#define CM_DISTORTION_COLUMNS 9

/* All loops for one instruction set; tables by index in the catalogue. */
typedef struct cm_batch_set
{
    const char *name;
    size_t lanes_f64; /* powers of two, CM_LANES_MAX at most */
    size_t lanes_f32;
    /* n numbers, at least one and no more than the lanes, to a vector, with the first of them for what is
     * missing. By one store, because the reading of a vector from several would wait for them all, and one call
     * for the other. */
    void (*rest_f64)(double *to, const double *from, size_t n);
    void (*rest_f32)(float *to, const float *from, size_t n);
    /* The nine columns of distortion.h from the six of forward Jacobians, or with of_tangents of inverse
     * ones; n is a multiple of the lanes. */
    void (*indicatrices_f64)(int of_tangents, size_t n, double *const jacobian[6],
                             double *const to[CM_DISTORTION_COLUMNS]);
    void (*indicatrices_f32)(int of_tangents, size_t n, float *const jacobian[6],
                             float *const to[CM_DISTORTION_COLUMNS]);
    const cm_batch_variants_f64 *f64;
    const cm_batch_variants_f32 *f32;
    /* forward and inverse of double arrays in lanes_f32, computed in float; NULL where that gains nothing */
    const cm_batch_variants_f64 *fast;
    const cm_chart_loops_f64 *charts_f64;
    const cm_chart_loops_f32 *charts_f32;
    const cm_lonlat_loops *lonlat;
    const cm_latitude_loops *latitudes;
    const cm_healpix_loops *healpix;
    const cm_healpix_lone *healpix_lone;
    const cm_cell_loops *cells;
    /* over points of what the table says, and unless that is NULL the torque (orient_bound.c) */
    double (*orient_sum)(const cm_orient_points *points, const cm_orient_table *table,
                         const float turn[9], double torque[3]);
    /* one point alone, by index in the catalogue; NULL for plain C */
    const cm_lone_variants_f64 *lone_f64;
    const cm_lone_variants_f32 *lone_f32;
} cm_batch_set;

#define CM_LANES_MAX 16

/* Points that are gathered at once from arrays with a stride; a multiple of CM_LANES_MAX. */
#define CM_BLOCK 256

/* Plain C: derives constants, and does what a set leaves out (set.inc). */
#ifdef CM_SMALL
#define CM_BATCH_PLAIN cm_batch_small
#else
#define CM_BATCH_PLAIN cm_batch_scalar
#endif

extern const cm_batch_set cm_batch_scalar;
extern const cm_batch_set cm_batch_small;
extern const cm_batch_set cm_batch_sse2;
extern const cm_batch_set cm_batch_avx2;
extern const cm_batch_set cm_batch_avx512;
extern const cm_batch_set cm_batch_neon;
extern const cm_batch_set cm_batch_wasm128;

/* Of each set, from the file of its points and pixels alone. */
extern const cm_lone_variants_f64 cm_lone_f64_sse2[];
extern const cm_lone_variants_f32 cm_lone_f32_sse2[];
extern const cm_lone_variants_f64 cm_lone_f64_avx2[];
extern const cm_lone_variants_f32 cm_lone_f32_avx2[];
extern const cm_lone_variants_f64 cm_lone_f64_avx512[];
extern const cm_lone_variants_f32 cm_lone_f32_avx512[];
extern const cm_lone_variants_f64 cm_lone_f64_neon[];
extern const cm_lone_variants_f32 cm_lone_f32_neon[];
extern const cm_lone_variants_f64 cm_lone_f64_wasm128[];
extern const cm_lone_variants_f32 cm_lone_f32_wasm128[];

#endif
