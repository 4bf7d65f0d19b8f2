/* SPDX-License-Identifier: MIT */
#include "random_set.h"

#include "instruction_set.h"

static const void *const sets[] = {
    &cm_random_scalar,
#ifdef CM_HAVE_SSE2
    &cm_random_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_random_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_random_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_random_neon,
#endif
};

const cm_random_set *cm_random_set_find(const char *name)
{
    return cm_scene_set_find(name, sets, sizeof sets / sizeof *sets);
}
