/* SPDX-License-Identifier: MIT */
#if defined(__linux__) && !defined(_DEFAULT_SOURCE)
#define _DEFAULT_SOURCE /* for madvise, in spite of -std=c11 */
#endif
#include "large_memory.h"

#include <stdlib.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif

#define HUGE_PAGE ((size_t)1 << 21)

/* To touch fresh memory first costs more than to filter it, and a fifth of that in huge pages. */
static void *of_system(size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (bytes >= 4 * HUGE_PAGE && bytes <= SIZE_MAX / 2)
    {
        const size_t whole = (bytes + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE;
        void *pointer = aligned_alloc(HUGE_PAGE, whole);
        if (pointer != NULL)
        {
            (void)madvise(pointer, whole, MADV_HUGEPAGE);
        }
        return pointer;
    }
#endif
    return bytes == 0 ? NULL : malloc(bytes);
}

void *cm_large_allocate(const cm_memory *memory, size_t bytes)
{
    return memory == NULL ? of_system(bytes)
           : bytes == 0   ? NULL
                          : memory->allocate(memory->context, bytes);
}

void cm_large_free(const cm_memory *memory, void *pointer, size_t bytes)
{
    if (memory == NULL)
    {
        free(pointer);
    }
    else if (pointer != NULL)
    {
        memory->release(memory->context, pointer, bytes);
    }
}

void cm_large_touched(const cm_memory *memory, size_t bytes)
{
    if (memory != NULL && memory->touched != NULL)
    {
        memory->touched(memory->context, bytes);
    }
}
