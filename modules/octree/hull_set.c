/* SPDX-License-Identifier: MIT */
#include "hull_set.h"

#include "named_set.h"

/* The scalar one first. */
static const void *const sets[] = {
    &cm_hull_scalar,
#ifdef CM_HAVE_SSE2
    &cm_hull_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_hull_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_hull_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_hull_neon,
#endif
};

const cm_hull_set *cm_hull_set_find(const char *name)
{
    return cm_named_set(name, sets, sizeof sets / sizeof *sets);
}
