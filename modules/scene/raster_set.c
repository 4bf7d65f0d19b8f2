/* SPDX-License-Identifier: MIT */
#include "raster_set.h"

#include "instruction_set.h"

static const void *const sets[] = {
    &cm_raster_scalar,
#ifdef CM_HAVE_SSE2
    &cm_raster_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_raster_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_raster_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_raster_neon,
#endif
};

const cm_raster_set *cm_raster_set_find(const char *name)
{
    return cm_scene_set_find(name, sets, sizeof sets / sizeof *sets);
}
