/* SPDX-License-Identifier: MIT */
#include "depth_set.h"

#include "instruction_set.h"

static const void *const sets[] = {
    &cm_depth_scalar,
#ifdef CM_HAVE_SSE2
    &cm_depth_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_depth_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_depth_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_depth_neon,
#endif
};

const cm_depth_set *cm_depth_set_find(const char *name)
{
    return cm_scene_set_find(name, sets, sizeof sets / sizeof *sets);
}
