/* SPDX-License-Identifier: MIT
 *
 * FNV-1a of 64 bits (Fowler, Noll & Vo 1991; RFC 9923), by which stores and streams know what is damaged. Each step is one
 * to one, so that a single wrong byte is always seen.
 */
#ifndef CUBEMAP_MODULES_SCENE_CHECK_SUM_H
#define CUBEMAP_MODULES_SCENE_CHECK_SUM_H

#include <stddef.h>
#include <stdint.h>

#define CM_CHECK_SUM_BEGIN 14695981039346656037u

/* The sum of what came before and count bytes more. */
static inline uint64_t cm_check_sum(uint64_t sum, const void *bytes, size_t count)
{
    const unsigned char *const from = (const unsigned char *)bytes;
    for (size_t i = 0; i < count; i++)
    {
        sum = (sum ^ from[i]) * 1099511628211u;
    }
    return sum;
}

#endif
