/* SPDX-License-Identifier: MIT */
#include "camera_set.h"

#include <cubemap/options.h>

#include <stdlib.h>
#include <string.h>

/* The simplest first, as cm_instructions_at has them. */
static const cm_camera_set *const sets[] = {
    &cm_camera_scalar,
#ifdef CM_HAVE_SSE2
    &cm_camera_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_camera_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_camera_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_camera_neon,
#endif
};

/* Libcubemap may be newer or older than this library: a set that only one of them has is not taken. */
static const cm_camera_set *set_of(const char *name)
{
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
    {
        if (strcmp(name, sets[i]->name) == 0)
        {
            return sets[i];
        }
    }
    return NULL;
}

static int is_wanted(const char *wanted, const char *name)
{
    for (; *wanted != '\0' && *name != '\0'; wanted++, name++)
    {
        const int low = *wanted >= 'A' && *wanted <= 'Z' ? *wanted - 'A' + 'a' : *wanted;
        if (low != *name)
        {
            return 0;
        }
    }
    return *wanted == *name;
}

const cm_camera_set *cm_camera_set_find(void)
{
    const char *wanted = getenv("CUBEMAP_INSTRUCTIONS");
    const cm_camera_set *best = &cm_camera_scalar;
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        const char *name = cm_instructions_at(i);
        const cm_camera_set *set = set_of(name);
        if (set != NULL && wanted != NULL && *wanted != '\0' && is_wanted(wanted, name))
        {
            return set;
        }
        best = set != NULL ? set : best;
    }
    return best;
}
