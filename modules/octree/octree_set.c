/* SPDX-License-Identifier: MIT */
#include "octree_set.h"

#include "named_set.h"

/* The scalar one first. */
static const void *const sets[] = {
    &cm_octree_scalar,
#ifdef CM_HAVE_SSE2
    &cm_octree_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_octree_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_octree_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_octree_neon,
#endif
};

const cm_octree_set *cm_octree_set_find(const char *name)
{
    return cm_named_set(name, sets, sizeof sets / sizeof *sets);
}
