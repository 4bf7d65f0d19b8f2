/* SPDX-License-Identifier: MIT
 *
 * How much of what is much a test does. The environment says so, and tests/meson.build the environment.
 */
#ifndef TESTS_AMOUNT_H
#define TESTS_AMOUNT_H

#include <stddef.h>
#include <stdlib.h>

/* Is a part of the many to do, as where coverage or sanitizers make a program slow, which ask about lines and not about
 * numbers? */
static inline int is_quick(void)
{
    return getenv("CUBEMAP_QUICK_TESTS") != NULL;
}

/* Is all to be done, as before a release: scripts/test --long? */
static inline int is_long(void)
{
    return getenv("CUBEMAP_LONG_TESTS") != NULL;
}

/* The step of a loop over many: 1, or as long as that. */
static inline size_t step_of(size_t quick)
{
    return is_quick() ? quick : 1;
}

/* The step where only the long run does all. */
static inline size_t long_step_of(size_t plain, size_t quick)
{
    return is_long() ? 1 : is_quick() ? quick : plain;
}

#endif
