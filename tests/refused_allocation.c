/* SPDX-License-Identifier: MIT */
#include "refused_allocation.h"

#include <stdatomic.h>
#include <stddef.h>

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __real_free(void *block);
void __wrap_free(void *block);

_Thread_local int blocks_until_refusal = -1;
static atomic_int alive;

int blocks_alive(void)
{
    return alive;
}

static int is_refused(void)
{
    return blocks_until_refusal >= 0 && blocks_until_refusal-- == 0;
}

static void *counted(void *block)
{
    alive += block != NULL;
    return block;
}

void *__wrap_malloc(size_t size)
{
    return is_refused() ? NULL : counted(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size)
{
    return is_refused() ? NULL : counted(__real_calloc(count, size));
}

void *__wrap_realloc(void *block, size_t size)
{
    const int is_new = block == NULL;
    void *grown = is_refused() ? NULL : __real_realloc(block, size);
    alive += grown != NULL && is_new;
    return grown;
}

void __wrap_free(void *block)
{
    alive -= block != NULL;
    __real_free(block);
}
