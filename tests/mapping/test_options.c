/* SPDX-License-Identifier: MIT
 *
 * Instruction sets and tiers: how they are named, chosen and refused.
 */
#define _POSIX_C_SOURCE 200809L

#include "tests/instructions_variable.h"
#include "tests/suite.h"

#include <cubemap/options.h>

static const char variable[] = "CUBEMAP_INSTRUCTIONS";

static const char *best(void)
{
    return cm_instructions_at(cm_instructions_count() - 1);
}

/* With that name in the options, or without options if it is NULL. */
static cm_status make(const char *name, cm_mapping **made)
{
    const cm_options options = {.size = sizeof options, .instructions = name};
    *made = NULL;
    return cm_mapping_create_with("qsc", NULL, name == NULL ? NULL : &options, made);
}

static void expect_set(const char *name, const char *expected)
{
    cm_mapping *made;
    ck_assert_int_eq(make(name, &made), CM_OK);
    ck_assert_str_eq(cm_mapping_instructions(made), expected);
    ck_assert_int_eq(cm_instructions_check(name, NULL, 0), CM_OK);
    cm_mapping_destroy(made);
}

static void expect_no_set(const char *name, const char *message)
{
    cm_mapping *made;
    char text[200];
    ck_assert_int_eq(make(name, &made), CM_ERROR_INSTRUCTIONS);
    ck_assert_ptr_null(made);
    ck_assert_int_eq(cm_instructions_check(name, text, sizeof text), CM_ERROR_INSTRUCTIONS);
    ck_assert_str_eq(text, message);
    for (size_t size = 0; size < sizeof text; size++)
    {
        char cut[sizeof text];
        memset(cut, 'x', sizeof cut);
        ck_assert_int_eq(cm_instructions_check(name, cut, size), CM_ERROR_INSTRUCTIONS);
        ck_assert(size == 0 || strlen(cut) == (size <= strlen(text) ? size - 1 : strlen(text)));
        ck_assert(size == 0 || strncmp(cut, text, size - 1) == 0);
        ck_assert_int_eq(cut[size], 'x');
    }
}

/* "the instruction set is 'NAME', but here it can be scalar, ..." */
static const char *refusal(const char *subject, const char *name)
{
    static char text[200];
    snprintf(text, sizeof text, "%s is '%s', but here it can be ", subject, name);
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        size_t length = strlen(text);
        snprintf(text + length, sizeof text - length, "%s%s", i == 0 ? "" : ", ",
                 cm_instructions_at(i));
    }
    return text;
}

START_TEST(sets_have_names)
{
    set_instructions_variable(NULL);
    ck_assert_uint_ge(cm_instructions_count(), 1);
    ck_assert_str_eq(cm_instructions_at(0), "scalar");
    ck_assert_ptr_null(cm_instructions_at(cm_instructions_count()));
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        expect_set(cm_instructions_at(i), cm_instructions_at(i));
        for (size_t k = 0; k < i; k++)
        {
            ck_assert_str_ne(cm_instructions_at(i), cm_instructions_at(k));
        }
    }
    expect_set("Scalar", "scalar");
}
END_TEST

START_TEST(the_best_set_is_the_default)
{
    set_instructions_variable(NULL);
    expect_set(NULL, best());
    expect_set("", best());
    set_instructions_variable("");
    expect_set(NULL, best());
    set_instructions_variable(NULL);
}
END_TEST

START_TEST(the_environment_chooses)
{
    for (size_t i = 0; i < cm_instructions_count(); i++)
    {
        set_instructions_variable(cm_instructions_at(i));
        expect_set(NULL, cm_instructions_at(i));
        expect_set("scalar", "scalar"); /* what the program says goes before */
    }
    set_instructions_variable("abacus");
    expect_no_set(NULL, refusal(variable, "abacus"));
    expect_set("scalar", "scalar");
    set_instructions_variable(NULL);
}
END_TEST

START_TEST(other_sets_are_refused)
{
    set_instructions_variable(NULL);
    expect_no_set("abacus", refusal("the instruction set", "abacus"));
    expect_no_set("scala", refusal("the instruction set", "scala"));
    expect_no_set("avx\n2", refusal("the instruction set", "avx?2"));
    /* no machine has both */
    const char *strange =
        cm_instructions_count() > 1 && strcmp(cm_instructions_at(1), "neon") == 0 ? "avx2" : "neon";
    expect_no_set(strange, refusal("the instruction set", strange));
}
END_TEST

static int is_offered(const cm_mapping_info *info)
{
    return info->fast != 0 && strcmp(best(), "scalar") != 0;
}

START_TEST(tiers)
{
    set_instructions_variable(NULL);
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        ck_assert_uint_eq(info->fast & ~(unsigned)(CM_FAST_FORWARD | CM_FAST_INVERSE), 0);
        for (int tier = 0; tier < 2; tier++)
        {
            const cm_options options = {.size = sizeof options, .tier = (cm_tier)tier};
            cm_mapping *made = NULL;
            cm_status status = cm_mapping_create_with(info->identifier, NULL, &options, &made);
            ck_assert_int_eq(status, CM_OK);
            ck_assert_int_eq((int)cm_mapping_tier(made), is_offered(info) ? tier : CM_TIER_EXACT);
            cm_mapping_destroy(made);
            const cm_options alone = {
                .size = sizeof alone, .instructions = "scalar", .tier = (cm_tier)tier};
            status = cm_mapping_create_with(info->identifier, NULL, &alone, &made);
            ck_assert_int_eq(status, CM_OK);
            ck_assert_int_eq((int)cm_mapping_tier(made), CM_TIER_EXACT);
            cm_mapping_destroy(made);
        }
    }
}
END_TEST

/* A map has other numbers in the fast tier than in the exact one where it is offered, and the same where
 * it is not; derivatives have the same. */
START_TEST(the_fast_tier_is_where_it_is_offered)
{
    set_instructions_variable(NULL);
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        const cm_mapping_info *info = cm_catalogue_at(i);
        const cm_options options = {.size = sizeof options, .tier = CM_TIER_FAST};
        cm_mapping *made[2] = {NULL, NULL};
        double uv[2][2], xyz[2][3], jacobian[2][2][6];
        uint8_t face[2];
        ck_assert_int_eq(cm_mapping_create(info->identifier, NULL, &made[0]), CM_OK);
        ck_assert_int_eq(cm_mapping_create_with(info->identifier, NULL, &options, &made[1]), CM_OK);
        for (int k = 0; k < 2; k++)
        {
            const double x = 0.7, y = 0.3, z = -0.2, u = 0.31, v = -0.62;
            const uint8_t of = 1;
            cm_forward_array(made[k], 1, &x, &y, &z, &face[k], &uv[k][0], &uv[k][1]);
            cm_inverse_array(made[k], 1, &of, &u, &v, &xyz[k][0], &xyz[k][1], &xyz[k][2]);
            cm_forward_jacobian(made[k], (double[3]){x, y, z}, jacobian[k][0]);
            cm_inverse_jacobian(made[k], of, (double[2]){u, v}, jacobian[k][1]);
        }
        int offered = is_offered(info);
        ck_assert_uint_eq(face[0], face[1]);
        ck_assert_int_eq(memcmp(uv[0], uv[1], sizeof uv[0]) != 0,
                         offered && (info->fast & CM_FAST_FORWARD) != 0);
        ck_assert_int_eq(memcmp(xyz[0], xyz[1], sizeof xyz[0]) != 0,
                         offered && (info->fast & CM_FAST_INVERSE) != 0);
        ck_assert_int_eq(memcmp(jacobian[0], jacobian[1], sizeof jacobian[0]), 0);
        cm_mapping_destroy(made[0]);
        cm_mapping_destroy(made[1]);
    }
}
END_TEST

START_TEST(wrong_options_are_refused)
{
    cm_mapping *made = NULL;
    const cm_options none = {.size = sizeof none};
    cm_options wrong = none;
    ck_assert_int_eq(cm_mapping_create_with(NULL, NULL, &none, &made), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_mapping_create_with("qsc", NULL, &none, NULL), CM_ERROR_ARGUMENT);
    wrong.size--;
    ck_assert_int_eq(cm_mapping_create_with("qsc", NULL, &wrong, &made), CM_ERROR_ARGUMENT);
    wrong = none;
    wrong.tier = (cm_tier)2;
    ck_assert_int_eq(cm_mapping_create_with("qsc", NULL, &wrong, &made), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_mapping_create_with("nothing", NULL, &none, &made), CM_ERROR_MAPPING);
    ck_assert_ptr_null(made);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {sets_have_names,
                            the_best_set_is_the_default,
                            the_environment_chooses,
                            other_sets_are_refused,
                            tiers,
                            the_fast_tier_is_where_it_is_offered,
                            wrong_options_are_refused,
                            NULL};
    return run_suite("options", tests);
}
