/* SPDX-License-Identifier: MIT
 *
 * The instruction sets of this build, and which of them this machine can run.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "set_choice.h"
#include "catalogue_words.h"
#include "message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* names the set that is used where the program does not */
#define VARIABLE "CUBEMAP_INSTRUCTIONS"

static int always(void)
{
    return 1;
}

/* The builtins ask the operating system too, whether it keeps the wide registers. */
#ifdef CM_HAVE_AVX2
static int has_avx2(void)
{
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#endif

#ifdef CM_HAVE_AVX512
static int has_avx512(void)
{
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
}
#endif

/* The simplest first. */
static const struct
{
    const cm_batch_set *set;
    int (*runs)(void);
} sets[] = {
#ifndef CM_WITHOUT_SCALAR
    {&cm_batch_scalar, always},
#endif
#ifdef CM_HAVE_SSE2
    {&cm_batch_sse2, always},
#endif
#ifdef CM_HAVE_AVX2
    {&cm_batch_avx2, has_avx2},
#endif
#ifdef CM_HAVE_AVX512
    {&cm_batch_avx512, has_avx512},
#endif
#ifdef CM_HAVE_NEON
    {&cm_batch_neon, always},
#endif
#ifdef CM_HAVE_WASM128
    {&cm_batch_wasm128, always},
#endif
};

static const cm_batch_set *set_at(size_t index)
{
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
    {
        if (sets[i].runs() && index-- == 0)
        {
            return sets[i].set;
        }
    }
    return NULL;
}

/* The last that runs: points one by one, too, ask for it. */
static const cm_batch_set *best_set(void)
{
    size_t i = sizeof sets / sizeof *sets - 1; /* the first runs everywhere */
    while (!sets[i].runs())
    {
        i--;
    }
    return sets[i].set;
}

size_t cm_instructions_count(void)
{
    size_t count = 0;
    while (set_at(count) != NULL)
    {
        count++;
    }
    return count;
}

const char *cm_instructions_at(size_t index)
{
    const cm_batch_set *set = set_at(index);
    return set == NULL ? NULL : set->name;
}

const cm_batch_set *cm_batch_set_find(const char *name)
{
    const char *wanted = name != NULL ? name : getenv(VARIABLE);
    if (wanted == NULL || *wanted == '\0')
    {
        return best_set();
    }
    for (size_t i = 0; set_at(i) != NULL; i++)
    {
        const char *have = set_at(i)->name;
        if (cm_word_equal(wanted, strlen(wanted), have, strlen(have)))
        {
            return set_at(i);
        }
    }
    return NULL;
}

cm_status cm_instructions_check(const char *name, char *message, size_t message_size)
{
    if (cm_batch_set_find(name) != NULL)
    {
        return CM_OK;
    }
    const char *wanted = name != NULL ? name : getenv(VARIABLE);
    char known[64] = "";
    for (size_t i = 0; set_at(i) != NULL; i++)
    {
        size_t length = strlen(known);
        snprintf(known + length, sizeof known - length, "%s%s", i == 0 ? "" : ", ",
                 set_at(i)->name);
    }
    return cm_fail(CM_ERROR_INSTRUCTIONS, message, message_size,
                   "%s is '%.32s', but here it can be %s",
                   name != NULL ? "the instruction set" : VARIABLE, wanted, known);
}
