/* SPDX-License-Identifier: MIT */
#include "raster_set.h"

#include "set_name.h"

#include <string.h>

enum
{
    SETS_MOST = 5
};

static const cm_raster_set *const sets[] = {
    &cm_raster_scalar,
#ifdef CM_HAVE_SSE2
    &cm_raster_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_raster_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_raster_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_raster_neon,
#endif
};

const cm_raster_set *cm_raster_set_find(const char *name)
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
