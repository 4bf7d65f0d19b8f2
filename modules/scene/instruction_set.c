/* SPDX-License-Identifier: MIT */
#include "instruction_set.h"

#include <cubemap/options.h>

#include <stdlib.h>
#include <string.h>

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

static const void *named(const void *const *sets, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
    {
        if (strcmp(*(const char *const *)sets[i], name) == 0)
        {
            return sets[i];
        }
    }
    return NULL;
}

/* Libcubemap may be newer or older than this library: a set that only one of them has is not taken. */
const void *cm_scene_set_find(const char *instructions, const void *const *sets, size_t count)
{
    if (cm_instructions_check(instructions, NULL, 0) != CM_OK)
    {
        return NULL;
    }
    const char *wanted = instructions != NULL ? instructions : getenv("CUBEMAP_INSTRUCTIONS");
    const int any = wanted == NULL || *wanted == '\0';
    const void *best = NULL;
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        const char *name = cm_instructions_at(i);
        const void *set = any || equal_words(name, wanted) ? named(sets, count, name) : NULL;
        best = set != NULL ? set : best;
    }
    return best;
}
