/* SPDX-License-Identifier: MIT
 *
 * Budgets: what a limit of error or of cost keeps, and their JSON.
 */
#include <cubemap/budget.h>

#include "tests/suite.h"

enum
{
    COUNT = 5
};

static cm_budget_entry entries[COUNT];

static cm_budget make(void)
{
    static const struct
    {
        const char *name;
        double contribution;
        double cost;
    } some[COUNT] = {{"distortion", 8.0, 2.0},
                     {"rolling shutter", 3.0, 3.0},
                     {"multipath", 5.0, 10.0},
                     {"noise", 1.0, 0.0},
                     {"vignetting", 0.0, 1.0}};
    for (int i = 0; i < COUNT; i++)
    {
        entries[i] = (cm_budget_entry){.size = sizeof(cm_budget_entry),
                                       .name = some[i].name,
                                       .contribution = some[i].contribution,
                                       .cost = some[i].cost};
    }
    return (cm_budget){.size = sizeof(cm_budget),
                       .subject = "camera",
                       .unit = "mm",
                       .cost_unit = "ms",
                       .count = COUNT,
                       .entry = entries};
}

static void expect_kept(const char *kept)
{
    for (int i = 0; i < COUNT; i++)
    {
        REQUIRE(entries[i].is_kept == (kept[i] == 'k'), "%s: %d, for '%s'", entries[i].name,
                entries[i].is_kept, entries[i].reason);
        ck_assert_ptr_nonnull(entries[i].reason);
    }
}

START_TEST(a_limit_of_error)
{
    static const struct
    {
        double limit;
        const char *kept;
        double error;
        double cost;
    } cases[] = {
        {0.0, "kkkkd", 0.0, 15.0},  {2.9, "kkkkd", 0.0, 15.0},
        {3.0, "kdkkd", 3.0, 12.0}, /* not multipath, which is too much, but what is behind it */
        {5.0, "kkdkd", 5.0, 5.0},   {8.0, "kddkd", 8.0, 2.0},
        {16.0, "dddkd", 16.0, 0.0}, {(double)INFINITY, "dddkd", 16.0, 0.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
        cm_budget budget = make();
        ck_assert_int_eq(cm_budget_limit_error(&budget, cases[i].limit), CM_OK);
        expect_kept(cases[i].kept);
        ck_assert(budget.error == cases[i].error && budget.cost == cases[i].cost);
    }
    cm_budget budget = make();
    entries[2].is_required = 1;
    ck_assert_int_eq(cm_budget_limit_error(&budget, 100.0), CM_OK);
    expect_kept("ddkkd");
}
END_TEST

START_TEST(a_limit_of_cost)
{
    static const struct
    {
        double limit;
        const char *kept;
        double error;
        double cost;
    } cases[] = {{0.0, "dddkd", 16.0, 0.0},  {2.0, "kddkd", 8.0, 2.0},  {5.0, "kkdkd", 5.0, 5.0},
                 {14.9, "kkdkd", 5.0, 5.0},  {12.0, "kkdkd", 5.0, 5.0}, {15.0, "kkkkd", 0.0, 15.0},
                 {1e300, "kkkkd", 0.0, 15.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
        cm_budget budget = make();
        ck_assert_int_eq(cm_budget_limit_cost(&budget, cases[i].limit), CM_OK);
        expect_kept(cases[i].kept);
        ck_assert(budget.error == cases[i].error && budget.cost == cases[i].cost);
    }
    cm_budget budget = make();
    entries[2].is_required = 1;
    ck_assert_int_eq(cm_budget_limit_cost(&budget, 12.5), CM_OK);
    expect_kept("kdkkd");
    const char *reason = entries[0].reason;
    ck_assert_int_eq(cm_budget_limit_cost(&budget, 9.0), CM_ERROR_SPACE);
    ck_assert(budget.cost == 12.0 && entries[0].reason == reason);
}
END_TEST

START_TEST(what_is_no_budget)
{
    cm_budget budget = make();
    size_t length = 7;
    char text[8] = "as";
    ck_assert_int_eq(cm_budget_sum(NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_budget_limit_cost(NULL, 1.0), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_budget_json(NULL, text, 8, &length), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_budget_json(&budget, NULL, 8, &length), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_budget_json(&budget, text, 8, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_budget_limit_cost(&budget, (double)NAN), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_budget_limit_error(&budget, -1.0), CM_ERROR_RANGE);
    entries[3].contribution = -1.0;
    ck_assert_int_eq(cm_budget_limit_error(&budget, 1.0), CM_ERROR_RANGE);
    entries[3].contribution = 1e308;
    entries[2].contribution = 1e308;
    ck_assert_int_eq(cm_budget_sum(&budget), CM_ERROR_RANGE);
    budget = make();
    entries[1].cost = (double)NAN;
    ck_assert_int_eq(cm_budget_limit_error(&budget, 1.0), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_budget_json(&budget, text, 8, &length), CM_ERROR_RANGE);
    budget = make();
    entries[1].unit = "cycles";
    ck_assert_int_eq(cm_budget_limit_error(&budget, 1.0), CM_ERROR_UNSUPPORTED);
    entries[1].unit = "mm";
    ck_assert_int_eq(cm_budget_limit_error(&budget, 1.0), CM_OK);
    entries[4].size = 1;
    ck_assert_int_eq(cm_budget_limit_error(&budget, 1.0), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_budget_json(&budget, text, 8, &length), CM_ERROR_ARGUMENT);
    budget.entry = NULL;
    ck_assert_int_eq(cm_budget_sum(&budget), CM_ERROR_ARGUMENT);
    ck_assert(length == 7 && strcmp(text, "as") == 0);
}
END_TEST

START_TEST(as_json)
{
    static const char expected[] =
        "{\"subject\": \"a \\\"b\\\\c\\u000a\\ufffd\xc3\xa9\", \"unit\": null, \"cost_unit\": "
        "\"ms\", "
        "\"error\": 0, \"cost\": 2.5, \"entries\": [\n"
        "  {\"name\": \"x\", \"contribution\": 0.1, \"unit\": \"m\", \"cost\": 2.5, \"required\": "
        "true, "
        "\"kept\": true, \"reason\": \"required\"},\n"
        "  {\"name\": null, \"contribution\": 0, \"unit\": null, \"cost\": 0, \"required\": false, "
        "\"kept\": false, \"reason\": null}]}\n";
    cm_budget_entry two[2] = {{.size = sizeof two[0],
                               .name = "x",
                               .contribution = 0.1,
                               .unit = "m",
                               .cost = 2.5,
                               .is_required = 1,
                               .is_kept = 1,
                               .reason = "required"},
                              {.size = sizeof two[0]}};
    const cm_budget budget = {.size = sizeof budget,
                              .subject = "a \"b\\c\n\xff\xc3\xa9",
                              .cost_unit = "ms",
                              .cost = 2.5,
                              .count = 2,
                              .entry = two};
    char text[1000];
    size_t length = 0;
    ck_assert_int_eq(cm_budget_json(&budget, NULL, 0, &length), CM_ERROR_SPACE);
    ck_assert_uint_eq(length, sizeof expected - 1);
    memset(text, 'z', sizeof text);
    ck_assert_int_eq(cm_budget_json(&budget, text, length, &length), CM_ERROR_SPACE);
    ck_assert(text[0] == 'z' && text[length] == 'z');
    ck_assert_int_eq(cm_budget_json(&budget, text, length + 1, &length), CM_OK);
    REQUIRE(strcmp(text, expected) == 0, "%s", text);
    ck_assert(text[length + 1] == 'z');
    const cm_budget none = {.size = sizeof none};
    ck_assert_int_eq(cm_budget_json(&none, text, sizeof text, &length), CM_OK);
    ck_assert_str_eq(text, "{\"subject\": null, \"unit\": null, \"cost_unit\": null, \"error\": 0, "
                           "\"cost\": 0, \"entries\": []}\n");
}
END_TEST

/* Bytes that are no UTF-8: too long, surrogates, beyond the last, cut off. */
START_TEST(texts_that_are_none)
{
    static const char *const bad[] = {"\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80",
                                      "\xe2\x82", "\x80",         "\xf8\x88\x80\x80\x80"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    {
        char text[300];
        size_t length;
        const cm_budget budget = {.size = sizeof budget, .subject = bad[i]};
        ck_assert_int_eq(cm_budget_json(&budget, text, sizeof text, &length), CM_OK);
        for (size_t k = 0; k < length; k++)
        {
            ck_assert((unsigned char)text[k] < 0x80);
        }
        ck_assert_ptr_nonnull(strstr(text, "\\ufffd"));
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_limit_of_error, a_limit_of_cost,     what_is_no_budget,
                                  as_json,          texts_that_are_none, NULL};
    return run_suite("budget", tests);
}
