/* SPDX-License-Identifier: MIT
 *
 * A system that refuses memory once: for suites that are linked with --wrap of malloc, calloc, realloc and free against the
 * static libraries. One program reads this once.
 */
#ifndef TESTS_SCENE_REFUSED_ALLOCATION_H
#define TESTS_SCENE_REFUSED_ALLOCATION_H

#include <stddef.h>

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __real_free(void *block);
void __wrap_free(void *block);

/* Allocations until one fails; below 0: none does. */
static int left = -1;
/* Blocks that were not given back. */
static int live;

static int is_refused(void)
{
    return left >= 0 && left-- == 0;
}

static void *counted(void *block)
{
    live += block != NULL;
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
    void *grown = is_refused() ? NULL : __real_realloc(block, size);
    live += grown != NULL && block == NULL;
    return grown;
}

void __wrap_free(void *block)
{
    live -= block != NULL;
    __real_free(block);
}

#endif
