/* SPDX-License-Identifier: MIT */
#include "gather_set.h"

#include <string.h>

static const gather_set *const sets[] = {
    &cm_gather_scalar,
#ifdef CM_HAVE_SSE2
    &cm_gather_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_gather_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_gather_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_gather_neon,
#endif
};

const gather_set *gather_set_find(const char *name)
{
    const gather_set *found = &cm_gather_scalar;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
    {
        found = strcmp(name, sets[i]->name) == 0 ? sets[i] : found;
    }
    return found;
}
