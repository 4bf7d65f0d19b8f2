/* SPDX-License-Identifier: MIT
 *
 * What healpix_loops.inc makes, and what it reads of a numbering of pixels.
 */
#ifndef LIBCUBEMAP_BATCH_HEALPIX_LOOPS_H
#define LIBCUBEMAP_BATCH_HEALPIX_LOOPS_H

#include <cubemap/healpix.h>

#include <stddef.h>
#include <stdint.h>

struct cm_batch_set;

struct cm_healpix
{
    int64_t nside;
    int64_t count; /* of pixels */
    cm_healpix_order order;
    int is_power;   /* of two, of nside */
    unsigned shift; /* its exponent then, else 0 */
    const struct cm_batch_set *set;
};

/* The loops of an instruction set (healpix_loops.inc), over whole vectors: n is a multiple of its lanes. With
 * latitudes the angles are latitude and longitude instead of theta and phi. Numbers are in the object's order,
 * but for the last two. */
typedef struct cm_healpix_loops
{
    void (*from_directions)(const cm_healpix *healpix, size_t n, const double *x, const double *y,
                            const double *z, int64_t *pixel);
    void (*from_angles)(const cm_healpix *healpix, int latitudes, size_t n, const double *theta,
                        const double *phi, int64_t *pixel);
    void (*to_directions)(const cm_healpix *healpix, size_t n, const int64_t *pixel, double *x,
                          double *y, double *z);
    void (*to_angles)(const cm_healpix *healpix, int latitudes, size_t n, const int64_t *pixel,
                      double *theta, double *phi);
    void (*to_nested)(const cm_healpix *healpix, size_t n, const int64_t *ring, int64_t *nested);
    void (*to_ring)(const cm_healpix *healpix, size_t n, const int64_t *nested, int64_t *ring);
} cm_healpix_loops;

/* The same of one point or pixel alone (lone.inc), to the bit. A pixel must be one; what is no point gives
 * CM_HEALPIX_NO_PIXEL.
 *
 * The first two are shorter ways, which may give that for any point: those to which they give a pixel have it by the other
 * ways, too. They raise no exception but inexact; nor do the ways from pixels, and to_ring raises none. */
typedef struct cm_healpix_lone
{
    int64_t (*short_from_direction)(const cm_healpix *healpix, const double direction[3]);
    int64_t (*short_from_angles)(const cm_healpix *healpix, int latitudes, double theta,
                                 double phi);
    int64_t (*from_direction)(const cm_healpix *healpix, const double direction[3]);
    int64_t (*from_angles)(const cm_healpix *healpix, int latitudes, double theta, double phi);
    void (*to_direction)(const cm_healpix *healpix, int64_t pixel, double direction[3]);
    void (*to_angles)(const cm_healpix *healpix, int latitudes, int64_t pixel, double *theta,
                      double *phi);
    int64_t (*to_nested)(const cm_healpix *healpix, int64_t ring);
    int64_t (*to_ring)(const cm_healpix *healpix, int64_t nested);
} cm_healpix_lone;

extern const cm_healpix_lone cm_healpix_lone_scalar;
extern const cm_healpix_lone cm_healpix_lone_sse2;
extern const cm_healpix_lone cm_healpix_lone_avx2;
extern const cm_healpix_lone cm_healpix_lone_avx512;
extern const cm_healpix_lone cm_healpix_lone_neon;
extern const cm_healpix_lone cm_healpix_lone_wasm128;

#endif
