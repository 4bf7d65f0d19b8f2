/* SPDX-License-Identifier: MIT
 *
 * The instruction sets that this machine has.
 */
#ifndef TESTS_SETS_HERE_H
#define TESTS_SETS_HERE_H

#include "modules/image/sample_set.h"
#include "tests/suite.h"

/* Its loops; index is that of cm_instructions_at. */
static inline const cm_sample_set *set_at(size_t index)
{
    const char *name = cm_instructions_at(index);
    const cm_sample_set *set = cm_sample_set_find(name);
    REQUIRE(set != NULL, "%s", name);
    ck_assert_str_eq(set->name, name);
    return set;
}

#endif
