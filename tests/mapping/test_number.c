/* SPDX-License-Identifier: MIT
 *
 * Decimal numbers against the C library's in the C locale, which rounds correctly: where they are hard.
 */
#include "tests/suite.h"

/* What strtod makes of a text that is a number here, with every bit. */
static void check_read(const char *text)
{
    char *end;
    double value = 77.0;
    const double wanted = strtod(text, &end);
    const size_t count = cm_number_read(text, strlen(text), &value);
    REQUIRE(count == (size_t)(end - text), "%zu bytes of %.80s, not %td", count, text, end - text);
    REQUIRE(memcmp(&value, &wanted, sizeof value) == 0, "%.80s is %a, not %a", text, value, wanted);
}

static void check_write(double value, int digits)
{
    char text[CM_NUMBER_SIZE];
    char wanted[64];
    const size_t length = cm_number_write(value, digits, text);
    snprintf(wanted, sizeof wanted, "%.*g", digits, value);
    REQUIRE(strcmp(text, wanted) == 0 && length == strlen(text), "%a is %s, not %s", value, text,
            wanted);
}

static uint64_t next_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

static double next_double(uint64_t *state)
{
    const uint64_t bits = next_random(state);
    double value;
    memcpy(&value, &bits, sizeof value);
    return isfinite(value) ? value : 1.0;
}

START_TEST(forms)
{
    static const struct
    {
        const char *text;
        size_t count;
        double value;
    } good[] = {{"3", 1, 3.0},      {"-.5", 3, -0.5},   {"2.", 2, 2.0},  {"+1e-9", 5, 1e-9},
                {"1E+2", 4, 100.0}, {"1e", 1, 1.0},     {"1e+", 1, 1.0}, {"1.5.2", 3, 1.5},
                {"0x10", 1, 0.0},   {"12 13", 2, 12.0}, {"1,5", 1, 1.0}, {"1e5x", 3, 1e5},
                {"007", 3, 7.0},    {"-0", 2, -0.0},    {"1-2", 1, 1.0}, {"5e3e2", 3, 5000.0}};
    static const char *const none[] = {"",    "-",   "+",  ".",   "e5",  "-.", ".e1",
                                       "inf", "nan", " 1", "--1", "+-1", "x"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
    {
        double value = 77.0;
        const size_t length = strlen(good[i].text);
        ck_assert_uint_eq(cm_number_read(good[i].text, length, &value), good[i].count);
        ck_assert_msg(memcmp(&value, &good[i].value, sizeof value) == 0, "%s", good[i].text);
        value = 77.0;
        ck_assert_int_eq(cm_number_parse(good[i].text, length, &value), good[i].count == length);
        ck_assert_double_eq(value, good[i].count == length ? good[i].value : 77.0);
    }
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
    {
        double value = 77.0;
        ck_assert_uint_eq(cm_number_read(none[i], strlen(none[i]), &value), 0);
        ck_assert_int_eq(cm_number_parse(none[i], strlen(none[i]), &value), 0);
        ck_assert_double_eq(value, 77.0);
    }
}
END_TEST

/* Nothing beyond the length is read, and no zero byte is needed. */
START_TEST(ends)
{
    double value = 0.0;
    ck_assert_uint_eq(cm_number_read("12345", 3, &value), 3);
    ck_assert_double_eq(value, 123.0);
    ck_assert_uint_eq(cm_number_read("1e5", 2, &value), 1);
    ck_assert_uint_eq(cm_number_read("1", 0, &value), 0);
    ck_assert_uint_eq(cm_number_read(NULL, 0, &value), 0);
    char *exact = malloc(4);
    memcpy(exact, "1e+5", 4);
    ck_assert_uint_eq(cm_number_read(exact, 4, &value), 4);
    ck_assert_double_eq(value, 1e5);
    free(exact);
    /* what would be a sign stands beyond the end */
    exact = malloc(2);
    memcpy(exact, "1e", 2);
    ck_assert_uint_eq(cm_number_read(exact, 2, &value), 1);
    ck_assert_double_eq(value, 1.0);
    free(exact);
}
END_TEST

START_TEST(known_hard_numbers)
{
    static const char *const hard[] = {
        "9007199254740993",
        "9007199254740992.9999999999999999999999",
        "9007199254740993.00000000000000000000000000000000000000000001",
        "1e23",
        "8.5e22",
        "4.35e-28",
        "6.9294956446009195e15",
        "7205759403792793.2",
        "2.2250738585072011e-308", /* where PHP and Java once went round for ever */
        "2.2250738585072012e-308",
        "2.2250738585072014e-308",
        "4.9406564584124654e-324",
        "2.4703282292062327e-324",
        "2.4703282292062328e-324",
        "2.47032822920623272088284396434110686182e-324",
        "1.7976931348623157e308",
        "1.7976931348623158e308",
        "1.7976931348623159e308",
        "17976931348623158e292",
        "1e308",
        "1e309",
        "-1e400",
        "1e-400",
        "1e-323",
        "0e999999999999999999999999",
        "1e99999999999999999999999999",
        "-1e-99999999999999999999999999",
        "0.000000000000000000000000000000000000000000000000001e51",
        "100000000000000000000000000000000000000000000000000e-50",
        "1234567890123456789012345678901234567890"};
    for (size_t i = 0; i < sizeof hard / sizeof *hard; i++)
    {
        check_read(hard[i]);
    }
}
END_TEST

/* Halfway between two doubles, exactly, and a hair beside: a long double holds the middle. */
START_TEST(halfway)
{
    uint64_t state = 5;
    char text[1300];
    char beside[1300];
    for (size_t i = 0; i < 20000; i += step_of(20))
    {
        const double value = fabs(next_double(&state));
        const long double middle =
            ((long double)value + (long double)nextafter(value, HUGE_VAL)) / 2;
        snprintf(text, sizeof text, "%.*Le", i % 10 == 0 ? 770 : 20, middle);
        check_read(text);
        const size_t length = strcspn(text, "e");
        snprintf(beside, sizeof beside, "%.*s0000000001%s", (int)length, text, text + length);
        check_read(beside);
    }
}
END_TEST

START_TEST(all_magnitudes)
{
    uint64_t state = 6;
    for (size_t i = 0; i < 200000; i += step_of(20))
    {
        char text[64];
        const double value = i % 3 == 0 ? next_real(&state) : next_double(&state);
        snprintf(text, sizeof text, "%.*g", (int)(next_random(&state) % 30), value);
        check_read(text);
        check_write(value, 1 + (int)(next_random(&state) % 17));
    }
    for (size_t i = 0; i < 20000; i += step_of(20))
    {
        char text[1200];
        const uint64_t bits = next_random(&state) >> (12 + next_random(&state) % 52);
        double subnormal;
        memcpy(&subnormal, &bits, sizeof subnormal);
        snprintf(text, sizeof text, i % 20 == 0 ? "%.1074f" : "%.20e", subnormal);
        check_read(text);
        if (subnormal != 0.0)
        {
            check_write(subnormal, 1 + (int)(next_random(&state) % 17));
        }
    }
}
END_TEST

START_TEST(huge_texts)
{
    enum
    {
        LENGTH = 100000
    };
    char *text = malloc(LENGTH + 1);
    memset(text, '7', LENGTH);
    text[LENGTH] = '\0';
    check_read(text);
    text[1] = '.';
    check_read(text);
    memset(text, '0', LENGTH);
    memcpy(text, "0.", 2);
    memcpy(text + LENGTH - 8, "25e99990", 8);
    check_read(text);
    /* a power of two and a half unit, and a one far behind */
    memset(text, '0', LENGTH);
    memcpy(text, "9007199254740993.", 17);
    check_read(text);
    text[LENGTH - 1] = '1';
    check_read(text);
    free(text);
}
END_TEST

START_TEST(writing)
{
    char text[CM_NUMBER_SIZE];
    static const struct
    {
        double value;
        int digits;
        const char *text;
    } rows[] = {{0.0, 17, "0"},
                {-0.0, 17, "0"},
                {1.0, 17, "1"},
                {0.1, 17, "0.10000000000000001"},
                {0.1, 15, "0.1"},
                {-1.5e-5, 3, "-1.5e-05"},
                {1e100, 5, "1e+100"},
                {123456.0, 3, "1.23e+05"},
                {9.9996, 4, "10"},
                {2.5, 0, "2"},
                {2.5, 1000, "2.5"},
                {5e-324, 17, "4.9406564584124654e-324"},
                {-1.7976931348623157e308, 17, "-1.7976931348623157e+308"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    {
        ck_assert_uint_eq(cm_number_write(rows[i].value, rows[i].digits, text),
                          strlen(rows[i].text));
        ck_assert_str_eq(text, rows[i].text);
    }
    ck_assert_uint_eq(cm_number_write((double)NAN, 3, text), 3);
    ck_assert_str_eq(text, "nan");
    ck_assert_uint_eq(cm_number_write(-HUGE_VAL, 3, text), 4);
    ck_assert_str_eq(text, "-inf");
    ck_assert_uint_eq(cm_number_write_shortest(HUGE_VAL, text), 3);
    ck_assert_str_eq(text, "inf");
}
END_TEST

/* Halfway between two numbers of so many digits: to the even one, unless anything follows. */
START_TEST(writing_halfway)
{
    static const double whole[] = {15.0,  25.0,  35.0,  85.0,  95.0,   105.0,  115.0, 245.0,
                                   250.0, 251.0, 350.0, 950.0, 9950.0, 9951.0, 25e20, 35e20};
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++)
    {
        for (int digits = 1; digits < 5; digits++)
        {
            check_write(whole[i], digits);
            check_write(whole[i] + 0.5, digits);
        }
    }
}
END_TEST

START_TEST(shortest)
{
    uint64_t state = 7;
    char text[CM_NUMBER_SIZE];
    cm_number_write_shortest(0.1, text);
    ck_assert_str_eq(text, "0.1");
    cm_number_write_shortest(0.1 + 0.2, text);
    ck_assert_str_eq(text, "0.30000000000000004");
    for (size_t i = 0; i < 100000; i += step_of(20))
    {
        const double value = next_double(&state);
        double again = 0.0;
        const size_t length = cm_number_write_shortest(value, text);
        REQUIRE(cm_number_parse(text, length, &again) && again == value, "%a is %s", value, text);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {forms,      ends,    known_hard_numbers, halfway,  all_magnitudes,
                                  huge_texts, writing, writing_halfway,    shortest, NULL};
    return run_suite("number", tests);
}
