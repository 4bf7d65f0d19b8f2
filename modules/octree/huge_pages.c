/* SPDX-License-Identifier: MIT */
#if defined(__linux__) && !defined(_DEFAULT_SOURCE)
#define _DEFAULT_SOURCE /* for madvise, in spite of -std=c11 */
#endif
#include "huge_pages.h"

#include <stdint.h>
#include <stdlib.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif

#define HUGE_PAGE ((size_t)1 << 21)

/* Less is not worth a large page. What is, as windows of a view are, also begins at a whole line
 * of the cache: vectors that are stored there reach over two lines otherwise. */
#define WORTH_A_PAGE (HUGE_PAGE / 8)

void *cm_huge_allocate(size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (bytes >= WORTH_A_PAGE && bytes <= SIZE_MAX / 2)
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
    return malloc(bytes);
}
