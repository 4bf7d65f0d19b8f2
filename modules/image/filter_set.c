/* SPDX-License-Identifier: MIT */
#include "filter_set.h"

#include <string.h>

static const cm_filter_set *const sets[] = {
    &cm_filter_scalar,
#ifdef CM_HAVE_SSE2
    &cm_filter_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_filter_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_filter_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_filter_neon,
#endif
};

const cm_filter_set *cm_filter_set_find(const char *name)
{
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
    {
        if (strcmp(name, sets[i]->name) == 0)
        {
            return sets[i];
        }
    }
    return &cm_filter_scalar;
}
