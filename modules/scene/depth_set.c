/* SPDX-License-Identifier: MIT */
#include "depth_set.h"

#include "set_name.h"

#include <string.h>

enum
{
    SETS_MOST = 5
};

static const cm_depth_set *const sets[] = {
    &cm_depth_scalar,
#ifdef CM_HAVE_SSE2
    &cm_depth_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_depth_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_depth_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_depth_neon,
#endif
};

const cm_depth_set *cm_depth_set_find(const char *name)
{
    const char *names[SETS_MOST];
    const size_t count = sizeof sets / sizeof *sets;
    for (size_t i = 0; i < count; i++)
    {
        names[i] = sets[i]->name;
    }
    const char *found = cm_scene_set_name(name, names, count);
    for (size_t i = 0; found != NULL && i < count; i++)
    {
        if (strcmp(names[i], found) == 0)
        {
            return sets[i];
        }
    }
    return NULL;
}
