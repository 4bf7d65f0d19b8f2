/* SPDX-License-Identifier: MIT
 *
 * Which loops over pixels this machine can run: those of libcubemap's instruction sets.
 */
#include "sample_set.h"

#include <cubemap/options.h>

#include <stdlib.h>
#include <string.h>

/* The simplest first, as cm_instructions_at has them. */
static const cm_sample_set *const sets[] = {
    &cm_sample_scalar,
#ifdef CM_HAVE_SSE2
    &cm_sample_sse2,
#endif
#ifdef CM_HAVE_AVX2
    &cm_sample_avx2,
#endif
#ifdef CM_HAVE_AVX512
    &cm_sample_avx512,
#endif
#ifdef CM_HAVE_NEON
    &cm_sample_neon,
#endif
};

static int equal_words(const char *a, const char *b)
{
    for (; *a != '\0' && *b != '\0'; a++, b++)
    {
        const int low_a = *a >= 'A' && *a <= 'Z' ? *a - 'A' + 'a' : *a;
        const int low_b = *b >= 'A' && *b <= 'Z' ? *b - 'A' + 'a' : *b;
        if (low_a != low_b)
        {
            return 0;
        }
    }
    return *a == *b;
}

/* Libcubemap may be newer or older than this library: a set that only one of them has is not taken. */
static const cm_sample_set *set_of(const char *name)
{
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
    {
        if (equal_words(name, sets[i]->name))
        {
            return sets[i];
        }
    }
    return NULL;
}

const cm_sample_set *cm_sample_set_find(const char *name)
{
    if (cm_instructions_check(name, NULL, 0) != CM_OK)
    {
        return NULL;
    }
    const char *wanted = name != NULL ? name : getenv("CUBEMAP_INSTRUCTIONS");
    if (wanted != NULL && *wanted != '\0')
    {
        return set_of(wanted);
    }
    const cm_sample_set *best = NULL;
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        const cm_sample_set *set = set_of(cm_instructions_at(i));
        best = set != NULL ? set : best;
    }
    return best;
}
