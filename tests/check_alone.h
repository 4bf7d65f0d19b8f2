/* SPDX-License-Identifier: MIT
 *
 * What the suites use of Check, for builds that have none: other processors, 32 bits. A failure ends the program.
 */
#ifndef TESTS_CHECK_ALONE_H
#define TESTS_CHECK_ALONE_H

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct TTest
{
    const char *name;
    void (*run)(int);
} TTest;

#define START_TEST(name)                                                                           \
    static void name##_run(int);                                                                   \
    static const TTest name##_test = {#name, name##_run};                                          \
    static const TTest *const name = &name##_test;                                                 \
    static void name##_run(int _i)                                                                 \
    {                                                                                              \
        (void)_i;
#define END_TEST }

__attribute__((noreturn, format(printf, 4, 5))) static inline void
_ck_assert_failed(const char *file, int line, const char *what, const char *format, ...)
{
    printf("%s:%d: %s", file, line, what);
    if (format != NULL)
    {
        va_list arguments;
        va_start(arguments, format);
        printf(": ");
        vprintf(format, arguments);
        va_end(arguments);
    }
    printf("\n");
    exit(1);
}

#define ck_assert(condition) ck_assert_msg(condition, "%s", "")

#define CK_COMPARE(type, format, a, relation, b)                                                   \
    do                                                                                             \
    {                                                                                              \
        const type ck_a = (a);                                                                     \
        const type ck_b = (b);                                                                     \
        ck_assert_msg(ck_a relation ck_b, format " " #relation " " format, ck_a, ck_b);            \
    } while (0)

#define ck_assert_int_eq(a, b) CK_COMPARE(intmax_t, "%jd", a, ==, b)
#define ck_assert_int_ne(a, b) CK_COMPARE(intmax_t, "%jd", a, !=, b)
#define ck_assert_int_lt(a, b) CK_COMPARE(intmax_t, "%jd", a, <, b)
#define ck_assert_int_gt(a, b) CK_COMPARE(intmax_t, "%jd", a, >, b)
#define ck_assert_int_ge(a, b) CK_COMPARE(intmax_t, "%jd", a, >=, b)
#define ck_assert_uint_eq(a, b) CK_COMPARE(uintmax_t, "%ju", a, ==, b)
#define ck_assert_uint_lt(a, b) CK_COMPARE(uintmax_t, "%ju", a, <, b)
#define ck_assert_uint_le(a, b) CK_COMPARE(uintmax_t, "%ju", a, <=, b)
#define ck_assert_uint_gt(a, b) CK_COMPARE(uintmax_t, "%ju", a, >, b)
#define ck_assert_uint_ge(a, b) CK_COMPARE(uintmax_t, "%ju", a, >=, b)
#define ck_assert_double_eq(a, b) CK_COMPARE(double, "%.17g", a, ==, b)
#define ck_assert_double_ne(a, b) CK_COMPARE(double, "%.17g", a, !=, b)
#define ck_assert_double_lt(a, b) CK_COMPARE(double, "%.17g", a, <, b)
#define ck_assert_double_le(a, b) CK_COMPARE(double, "%.17g", a, <=, b)
#define ck_assert_double_gt(a, b) CK_COMPARE(double, "%.17g", a, >, b)
#define ck_assert_double_eq_tol(a, b, tolerance)                                                   \
    CK_COMPARE(double, "%.17g", fabs((a) - (b)), <=, tolerance)
#define ck_assert_double_nan(a) ck_assert_msg(isnan(a), "%.17g", (double)(a))
#define ck_assert_ptr_eq(a, b) CK_COMPARE(void *, "%p", (void *)(uintptr_t)(a), ==, (void *)(uintptr_t)(b))
#define ck_assert_ptr_ne(a, b) CK_COMPARE(void *, "%p", (void *)(uintptr_t)(a), !=, (void *)(uintptr_t)(b))
#define ck_assert_ptr_null(a) ck_assert_msg((a) == NULL, "%p", (const void *)(a))
#define ck_assert_ptr_nonnull(a) ck_assert_msg((a) != NULL, "%s", "")
#define ck_assert_mem_eq(a, b, size) ck_assert(memcmp(a, b, size) == 0)
#define ck_assert_str_eq(a, b) ck_assert_msg(strcmp(a, b) == 0, "\"%s\", not \"%s\"", a, b)
#define ck_assert_str_ne(a, b) ck_assert_msg(strcmp(a, b) != 0, "\"%s\"", a)

#endif
