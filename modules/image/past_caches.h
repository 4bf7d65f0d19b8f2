/* SPDX-License-Identifier: MIT
 *
 * Stores of whole lines of memory past the caches: what is written once and is larger than they are then need not be read
 * first, and drives nothing out.
 */
#ifndef MODULES_IMAGE_PAST_CACHES_H
#define MODULES_IMAGE_PAST_CACHES_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#define CM_HAVE_PAST_CACHES 1
#else
#define CM_HAVE_PAST_CACHES 0
#endif

#define CM_LINE 64

/* The first line of memory at a place or behind it. */
static inline void *cm_next_line(void *place)
{
    return (char *)place + (CM_LINE - (uintptr_t)place % CM_LINE) % CM_LINE;
}

/* Zeros that begin where a line does, in memory that is to be freed; NULL if there is none. */
static inline void *cm_zeros_in_lines(size_t bytes, void **memory)
{
    *memory = calloc(1, bytes + CM_LINE);
    return *memory == NULL ? NULL : cm_next_line(*memory);
}

/* `to` and bytes are multiples of CM_LINE. */
static inline void cm_store_past_caches(unsigned char *to, const unsigned char *from, size_t bytes)
{
#if CM_HAVE_PAST_CACHES
    for (size_t i = 0; i < bytes; i += CM_LINE)
    {
        const __m128i *line = (const __m128i *)(const void *)(from + i);
        __m128i *into = (__m128i *)(void *)(to + i);
        const __m128i a = _mm_loadu_si128(line);
        const __m128i b = _mm_loadu_si128(line + 1);
        const __m128i c = _mm_loadu_si128(line + 2);
        const __m128i d = _mm_loadu_si128(line + 3);
        _mm_stream_si128(into, a);
        _mm_stream_si128(into + 1, b);
        _mm_stream_si128(into + 2, c);
        _mm_stream_si128(into + 3, d);
    }
#else
    memcpy(to, from, bytes);
#endif
}

/* Whoever has stored so calls it before others are told that it is there. */
static inline void cm_finish_past_caches(void)
{
#if CM_HAVE_PAST_CACHES
    _mm_sfence();
#endif
}

#endif
