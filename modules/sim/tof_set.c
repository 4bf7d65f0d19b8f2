/* SPDX-License-Identifier: MIT */
#include "tof_set.h"

#include <cubemap/options.h>

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

static const tof_set *find(const char *name)
{
    const tof_set *found = &cm_tof_scalar;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
    {
        found = strcmp(name, sets[i]->name) == 0 ? sets[i] : found;
    }
    return found;
}

cm_status tof_set_choose(const tof_set **set)
{
    cm_mapping *mapping = NULL;
    const cm_status status = cm_mapping_create("gnomonic", NULL, &mapping);
    if (status == CM_OK)
    {
        *set = find(cm_mapping_instructions(mapping));
        cm_mapping_destroy(mapping);
    }
    return status;
}
