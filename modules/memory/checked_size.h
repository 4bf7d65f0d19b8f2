/* SPDX-License-Identifier: MIT
 *
 * Sizes of memory. Where size_t has 32 bits a picture that fits may need more than it can count: a product that wraps
 * would ask for a little, and what is written goes beyond it. Here such sums and products stay at SIZE_MAX, which no
 * system gives.
 */
#ifndef MODULES_MEMORY_CHECKED_SIZE_H
#define MODULES_MEMORY_CHECKED_SIZE_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

static inline size_t cm_size_sum(size_t a, size_t b)
{
    return a > SIZE_MAX - b ? SIZE_MAX : a + b;
}

static inline size_t cm_size_product(size_t a, size_t b)
{
    return b != 0 && a > SIZE_MAX / b ? SIZE_MAX : a * b;
}

/* Memory for `count` elements, to be freed; NULL without memory. */
static inline void *cm_array_of(size_t count, size_t element)
{
    return malloc(cm_size_product(count, element));
}

/* The same for an array that grows, as realloc has it. */
static inline void *cm_array_resized(void *array, size_t count, size_t element)
{
    return realloc(array, cm_size_product(count, element));
}

#endif
