/* SPDX-License-Identifier: MIT */
#include "octree_set.h"

#include <string.h>

static const cm_octree_set *const sets[] = {
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
    const cm_octree_set *found = &cm_octree_scalar;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
    {
        found = strcmp(name, sets[i]->name) == 0 ? sets[i] : found;
    }
    return found;
}
