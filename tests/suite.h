/* SPDX-License-Identifier: MIT
 *
 * What the Check suites share.
 */
#ifndef TESTS_SUITE_H
#define TESTS_SUITE_H

#include <cubemap/cubemap.h>

#ifdef WITHOUT_CHECK
#include "tests/check_alone.h"
#else
#include <check.h>
#endif
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/amount.h"
#include "truth/cube_count.h"
#include "truth/sphere.h"

/* Check's assertion writes a note into a file whenever it holds, and there are millions of them. This one does not, nor
 * do Check's others then, which are all made of ck_assert_msg. */
#define REQUIRE(condition, ...)                                                                    \
    ((condition) ? (void)0                                                                         \
                 : _ck_assert_failed(__FILE__, __LINE__, "Assertion '" #condition "' failed",      \
                                     __VA_ARGS__))
#undef ck_assert_msg
#define ck_assert_msg REQUIRE

#ifdef WITHOUT_CHECK
static inline int run_suite(const char *name, const TTest *const *tests)
{
    size_t count = 0;
    for (; tests[count] != NULL; count++)
    {
        tests[count]->run(0);
    }
    printf("%s: %zu tests without Check\n", name, count);
    return count == 0;
}
#else
static inline int run_suite(const char *name, const TTest *const *tests)
{
    Suite *suite = suite_create(name);
    TCase *tcase = tcase_create(name);
    tcase_set_timeout(tcase, 240.0);
    for (size_t i = 0; tests[i] != NULL; i++)
    {
        tcase_add_test(tcase, tests[i]);
    }
    suite_add_tcase(suite, tcase);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
#endif

static inline cm_mapping *make_mapping(const char *specification, const cm_frame *frame)
{
    cm_mapping *mapping = NULL;
    ck_assert_msg(cm_mapping_create(specification, frame, &mapping) == CM_OK, "%s", specification);
    ck_assert_ptr_nonnull(mapping);
    return mapping;
}

/* Call check for every mapping with its standard parameters, in every frame; if quick, in one. */
static inline void for_every_mapping(void (*check)(const cm_mapping *))
{
    const size_t count = cm_frame_count();
    for (size_t i = 0; i < cube_count(); i++)
    {
        for (size_t f = is_quick() ? i % count : 0; f < count; f += step_of(count))
        {
            cm_mapping *mapping = make_mapping(cm_catalogue_at(i)->identifier, cm_frame_at(f));
            check(mapping);
            cm_mapping_destroy(mapping);
        }
    }
}

#endif
