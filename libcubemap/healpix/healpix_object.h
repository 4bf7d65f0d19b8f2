/* SPDX-License-Identifier: MIT
 *
 * What the files about HEALPix's pixels share.
 */
#ifndef LIBCUBEMAP_HEALPIX_H
#define LIBCUBEMAP_HEALPIX_H

#include "libcubemap/mapping/internal.h"

#include <cubemap/healpix.h>

struct cm_healpix
{
    int64_t nside;
    int64_t count; /* of pixels */
    cm_healpix_order order;
    int is_power;   /* of two, of nside */
    unsigned shift; /* its exponent then, else 0 */
    const cm_batch_set *set;
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

/* Is there such a pixel? */
static inline int cm_healpix_has(const cm_healpix *healpix, int64_t pixel)
{
    return pixel >= 0 && pixel < healpix->count;
}

#endif
