/* SPDX-License-Identifier: MIT */
#include "hull_set.h"

#include <string.h>

static const cm_hull_set *const sets[] = {
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
    const cm_hull_set *found = &cm_hull_scalar;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
    {
        found = strcmp(name, sets[i]->name) == 0 ? sets[i] : found;
    }
    return found;
}
