/* SPDX-License-Identifier: MIT */
#include "place_set.h"

#include "sample_set.h"

#include <string.h>

static const cm_place_set *const sets[] = {
    &cm_place_scalar,
#ifdef CM_HAVE_SSE2
    &cm_place_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_place_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_place_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_place_neon,
#endif
};

const cm_place_set *cm_place_set_find(const char *name)
{
    const cm_sample_set *found = cm_sample_set_find(name);
    for (size_t i = 0; found != NULL && i < sizeof sets / sizeof *sets; i++)
    {
        if (strcmp(sets[i]->name, found->name) == 0)
        {
            return sets[i];
        }
    }
    return NULL;
}
