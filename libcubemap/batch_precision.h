/* SPDX-License-Identifier: MIT
 *
 * The loops of one instruction set whose arrays hold what they compute in. Read by batch_set.h, which
 * has defined CM_LANES_BITS, CM_SCALAR_NAME, LANES_IO, BATCH_NAME and BATCH_VARIANTS; the words of lanes/
 * stay defined.
 */
#ifdef CM_LANES
#define CM_BACKEND 5
#include <cubemap/kernel/backend.h>
#else
#if CM_LANES_BITS == 64
#define CM_BACKEND 1
#else
#define CM_BACKEND 2
#endif
#include <cubemap/kernel/dialect.h>

#include "lanes/scalar.h"
#endif

enum
{
    BATCH_NAME(lanes) = LANES
};

/* A mapping's numbers, in every lane. */
CM_FN CM_NAME(cm_constants) CM_NAME(lanes_constants)(const cm_mapping *mapping)
{
    const CM_SCALAR_NAME(cm_constants) *k = &mapping->CM_SCALAR_NAME(constants);
    CM_NAME(cm_constants) r;
    r.k0 = lanes_all(k->k0);
    r.k1 = lanes_all(k->k1);
    r.k2 = lanes_all(k->k2);
    r.k3 = lanes_all(k->k3);
    r.k4 = lanes_all(k->k4);
    r.k5 = lanes_all(k->k5);
    r.k6 = lanes_all(k->k6);
    r.variant = lanes_all(k->variant);
    return r;
}

/* Has it a direction: is it not zero, and are its components finite? */
CM_FN CM_BOOL CM_NAME(lanes_is_direction)(CM_REAL x, CM_REAL y, CM_REAL z)
{
    /* infinities times zero are NaN, which is not less than anything */
    CM_REAL zero = CM_LIT(0.0);
    return cm_less(cm_mad(x, zero, cm_mad(y, zero, z * zero)), CM_NAME(cm_magnitude)(x, y, z));
}

static void BATCH_NAME(rest)(LANES_IO *to, const LANES_IO *from, size_t n)
{
    lanes_store(to, n == 1 ? lanes_all(*from) : lanes_some(from, n));
}

/* In the order of cm_distortion. */
static void BATCH_NAME(indicatrices)(int of_tangents, size_t n, LANES_IO *const j[6],
                                     LANES_IO *const to[CM_DISTORTION_COLUMNS])
{
    for (size_t i = 0; i < n; i += LANES)
    {
        CM_REAL k0 = lanes_load(j[0] + i);
        CM_REAL k1 = lanes_load(j[1] + i);
        CM_REAL k2 = lanes_load(j[2] + i);
        CM_REAL k3 = lanes_load(j[3] + i);
        CM_REAL k4 = lanes_load(j[4] + i);
        CM_REAL k5 = lanes_load(j[5] + i);
        CM_NAME(cm_indicatrix) r;
        if (of_tangents)
        {
            CM_NAME(cm_tangents) t = {
                .x_a = k0, .x_b = k1, .y_a = k2, .y_b = k3, .z_a = k4, .z_b = k5};
            r = CM_NAME(cm_indicatrix_of_tangents)(t);
        }
        else
        {
            CM_NAME(cm_gradients) g = {
                .a_x = k0, .a_y = k1, .a_z = k2, .b_x = k3, .b_y = k4, .b_z = k5};
            r = CM_NAME(cm_indicatrix_of_gradients)(g);
        }
        lanes_store(to[0] + i, r.major);
        lanes_store(to[1] + i, r.minor);
        lanes_store(to[2] + i, r.orientation);
        lanes_store(to[3] + i, r.scale);
        lanes_store(to[4] + i, r.deformation);
        lanes_store(to[5] + i, r.area);
        lanes_store(to[6] + i, r.isotropy);
        lanes_store(to[7] + i, r.texel_aspect);
        lanes_store(to[8] + i, r.texel_area);
    }
}

#include "charts.h"
#if CM_LANES_BITS == 64
#include "lanes/words.h"
#include "lonlat.h"

#include "latitudes.h"
#include "healpix_loops.h"
#endif

#define lanes_read(p) lanes_load(p)
#define lanes_write(p, x) lanes_store(p, x)
#include "batch.h"
#if CM_LANES_BITS == 64
#include "cell_loops.h"
#endif
