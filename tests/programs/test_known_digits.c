/* SPDX-License-Identifier: MIT
 *
 * Figures are printed with the digits that their error leaves.
 */
#include "tests/suite.h"

#include "tools/cli/known_digits.h"

START_TEST(decimals)
{
    static const struct
    {
        double error;
        int decimals;
    } known[] = {{0.0, 6},    {1e-9, 6}, {5e-7, 6},  {6e-7, 5}, {0.0035, 2}, {0.005, 2},
                 {0.0051, 1}, {0.5, 0},  {0.51, -1}, {1e9, -1}, {NAN, -1},   {INFINITY, -1}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    {
        ck_assert_int_eq(known_decimals(known[i].error, 6), known[i].decimals);
    }
    ck_assert_int_eq(known_decimals(1e-17, 15), 15);
    ck_assert_int_eq(known_decimals(0.0, 0), 0);
}
END_TEST

static void expect_text(double value, double error, int most, const char *wanted)
{
    char text[KNOWN_TEXT_SIZE];
    ck_assert_str_eq(known_text(value, error, most, text), wanted);
}

START_TEST(texts)
{
    /* a sum that had not followed its singularity, and one that has */
    expect_text(0.5538, 0.0035, 4, "0.55");
    expect_text(0.554553597759, 2e-11, 4, "0.5546");
    expect_text(1.0, 0.0, 4, "1.0000");
    expect_text(3.7, 0.6, 4, "-");
    expect_text(3.7, 0.4, 4, "4");
    expect_text((double)INFINITY, 0.0, 4, "inf");
    expect_text(-(double)INFINITY, (double)NAN, 4, "-inf");
    expect_text((double)NAN, 0.0, 4, "-");
    expect_text(1.0, (double)NAN, 4, "-");
    char text[KNOWN_TEXT_SIZE];
    ck_assert_uint_lt(strlen(known_text(-1.7976931348623157e308, 0.0, 30, text)), KNOWN_TEXT_SIZE);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {decimals, texts, NULL};
    return run_suite("known digits", tests);
}
