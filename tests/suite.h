/* SPDX-License-Identifier: MIT
 *
 * What the Check suites share.
 */
#ifndef TESTS_SUITE_H
#define TESTS_SUITE_H

#include <cubemap/cubemap.h>

#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* metres; error on Earth = angle times this */
#define EARTH_RADIUS 6371007.2

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

static inline cm_mapping *make_mapping(const char *specification, const cm_frame *frame)
{
    cm_mapping *mapping = NULL;
    ck_assert_msg(cm_mapping_create(specification, frame, &mapping) == CM_OK, "%s", specification);
    ck_assert_ptr_nonnull(mapping);
    return mapping;
}

/* Call check for every mapping with its standard parameters, in every frame. */
static inline void for_every_mapping(void (*check)(const cm_mapping *))
{
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        for (size_t f = 0; f < cm_frame_count(); f++)
        {
            cm_mapping *mapping = make_mapping(cm_catalogue_at(i)->identifier, cm_frame_at(f));
            check(mapping);
            cm_mapping_destroy(mapping);
        }
    }
}

/* xorshift64*, so that a failure can be found again */
static inline uint64_t next_bits(uint64_t *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return *state * 0x2545f4914f6cdd1dull;
}

/* uniform in [-1, 1) */
static inline double next_real(uint64_t *state)
{
    return (double)(next_bits(state) >> 11) * 0x1p-52 - 1.0;
}

/* a point of the ball's shell between radius 1/4 and 1: a uniform direction of no special length */
static inline void next_direction(uint64_t *state, double direction[3])
{
    double square;
    do
    {
        square = 0.0;
        for (int i = 0; i < 3; i++)
        {
            direction[i] = next_real(state);
            square += direction[i] * direction[i];
        }
    } while (square > 1.0 || square < 0.0625);
}

/* the angle between two directions of any length, accurate when it is small */
static inline double angle_between(const double a[3], const double b[3])
{
    long double cross[3];
    long double dot = 0.0L;
    for (int i = 0; i < 3; i++)
    {
        int j = (i + 1) % 3;
        int k = (i + 2) % 3;
        cross[i] = (long double)a[j] * b[k] - (long double)a[k] * b[j];
        dot += (long double)a[i] * b[i];
    }
    return (double)atan2l(sqrtl(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]),
                          dot);
}

static inline double earth_metres(const double a[3], const double b[3])
{
    return angle_between(a, b) * EARTH_RADIUS;
}

#endif
