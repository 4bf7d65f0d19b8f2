/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE

#include "refused_allocation.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdlib.h>

/* glibc's, under the names that are left when a program has its own */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *block);
void *memalign(size_t alignment, size_t size);

_Thread_local int blocks_until_refusal = -1;
static atomic_int alive;

int blocks_alive(void)
{
    return alive;
}

static void refuse_nothing(void)
{
    blocks_until_refusal = -1;
}

void spare_children(void)
{
    pthread_atfork(NULL, NULL, refuse_nothing);
}

static int is_refused(void)
{
    if (blocks_until_refusal < 0 || blocks_until_refusal-- > 0)
    {
        return 0;
    }
    errno = ENOMEM;
    return 1;
}

static void *counted(void *block)
{
    alive += block != NULL;
    return block;
}

void *malloc(size_t size)
{
    return is_refused() ? NULL : counted(__libc_malloc(size));
}

void *calloc(size_t count, size_t size)
{
    return is_refused() ? NULL : counted(__libc_calloc(count, size));
}

void *realloc(void *block, size_t size)
{
    const int is_new = block == NULL;
    void *grown = is_refused() ? NULL : __libc_realloc(block, size);
    alive += grown != NULL && is_new;
    return grown;
}

void *memalign(size_t alignment, size_t size)
{
    return is_refused() ? NULL : counted(__libc_memalign(alignment, size));
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return memalign(alignment, size);
}

int posix_memalign(void **block, size_t alignment, size_t size)
{
    void *made = memalign(alignment, size);
    *block = made == NULL ? *block : made;
    return made == NULL ? ENOMEM : 0;
}

void free(void *block)
{
    alive -= block != NULL;
    __libc_free(block);
}
