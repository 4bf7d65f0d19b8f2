/* SPDX-License-Identifier: MIT
 *
 * Memory that begins on a line of the cache, where the C library has no aligned_alloc, too.
 */
#ifndef TESTS_IMAGE_ALIGNED_MEMORY_H
#define TESTS_IMAGE_ALIGNED_MEMORY_H

#include <stdlib.h>
#ifdef _WIN32
#include <malloc.h>
#endif

enum
{
    CACHE_LINE = 64
};

static inline void *allocate_aligned(size_t bytes)
{
#ifdef _WIN32
    return _aligned_malloc(bytes, CACHE_LINE);
#else
    return aligned_alloc(CACHE_LINE, (bytes + CACHE_LINE - 1) / CACHE_LINE * CACHE_LINE);
#endif
}

static inline void free_aligned(void *pointer)
{
#ifdef _WIN32
    _aligned_free(pointer);
#else
    free(pointer);
#endif
}

#endif
