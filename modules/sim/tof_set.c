/* SPDX-License-Identifier: MIT */
#include "tof_set.h"

#include <string.h>

static const tof_set *const sets[] = {
    &cm_tof_scalar,
#ifdef CM_HAVE_SSE2
    &cm_tof_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_tof_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_tof_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_tof_neon,
#endif
};

const tof_set *cm_tof_set_find(const char *name)
{
    const tof_set *found = &cm_tof_scalar;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
    {
        found = strcmp(name, sets[i]->name) == 0 ? sets[i] : found;
    }
    return found;
}
