/* SPDX-License-Identifier: MIT
 *
 * What the files about HEALPix's pixels share.
 */
#ifndef LIBCUBEMAP_HEALPIX_HEALPIX_OBJECT_H
#define LIBCUBEMAP_HEALPIX_HEALPIX_OBJECT_H

#include <cubemap/kernels.h>

#include "libcubemap/batch/batch_set.h"

#include <cubemap/healpix.h>

/* Is there such a pixel? */
static inline int cm_healpix_has(const cm_healpix *healpix, int64_t pixel)
{
    return pixel >= 0 && pixel < healpix->count;
}

#endif
