/* SPDX-License-Identifier: MIT
 *
 * Colour maps: the catalogue, specifications, and what is refused.
 */
#define _POSIX_C_SOURCE 200809L

#include "many_colormaps.h"

#include <locale.h>

/* ---------------------------------------------------------------- memory that cannot be had */

#ifdef WRAPS_MALLOC
void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);

static int exhausted;

void *__wrap_malloc(size_t size)
{
    return exhausted ? NULL : __real_malloc(size);
}
#endif

/* ---------------------------------------------------------------- the catalogue */

START_TEST(catalogue)
{
    ck_assert_uint_eq(cm_colormap_count(), 14);
    ck_assert_ptr_null(cm_colormap_at(cm_colormap_count()));
    ck_assert_ptr_null(cm_colormap_find(NULL));
    ck_assert_ptr_null(cm_colormap_find(""));
    ck_assert_ptr_null(cm_colormap_find("sequential-singl"));
    ck_assert_ptr_null(cm_colormap_find("sequential single"));
    ck_assert_ptr_eq(cm_colormap_find("Sequential"), cm_colormap_at(0));
    ck_assert_ptr_eq(cm_colormap_find("SINGLE"), cm_colormap_at(0));
    for (size_t i = 0; i < cm_colormap_count(); i++)
    {
        const cm_colormap_info *info = cm_colormap_at(i);
        ck_assert_ptr_eq(cm_colormap_find(info->identifier), info);
        ck_assert(strlen(info->name) > 0 && strlen(info->source) > 0);
        ck_assert_uint_le(info->parameter_count, CM_COLORMAP_PARAMETERS_MAX);
        for (size_t k = 0; k < info->parameter_count; k++)
        {
            const cm_colormap_parameter_info *p = &info->parameter[k];
            ck_assert(strlen(p->name) > 0 && strlen(p->meaning) > 0);
            ck_assert(p->low < p->high);
            ck_assert(p->stops != NULL || (p->standard >= p->low && p->standard <= p->high));
            ck_assert_int_eq(isnan(p->standard) != 0, p->stops != NULL);
        }
    }
}
END_TEST

START_TEST(standard_maps)
{
    for (size_t i = 0; i < cm_colormap_count(); i++)
    {
        const cm_colormap_info *info = cm_colormap_at(i);
        cm_colormap *map = make(info->identifier);
        ck_assert_ptr_eq(cm_colormap_describe(map), info);
        REQUIRE(cm_colormap_inside(map), "%s is not inside sRGB", info->identifier);
        REQUIRE(is_uniform(map)
                    ? isinf(cm_colormap_largest_saturation(map))
                    : cm_colormap_largest_saturation(map) > parameter(map, "saturation"),
                "%s", info->identifier);
        for (size_t k = 0; k < info->parameter_count; k++)
        {
            double value = cm_colormap_parameter(map, k);
            ck_assert(info->parameter[k].stops != NULL ? isnan(value)
                                                       : value == info->parameter[k].standard);
        }
        ck_assert_double_nan(cm_colormap_parameter(map, info->parameter_count));
        cm_colormap_destroy(map);
    }
    cm_colormap_destroy(NULL);
}
END_TEST

/* ---------------------------------------------------------------- specifications */

static void expect_error(const char *specification, cm_status status, const char *message)
{
    char text[400] = "untouched";
    cm_colormap *untouched = (cm_colormap *)&text;
    cm_colormap *map = untouched;
    REQUIRE(cm_colormap_check(specification, text, sizeof text) == status, "%s: %s", specification,
            text);
    ck_assert_str_eq(text, message);
    ck_assert_int_eq(cm_colormap_create(specification, &map), status);
    ck_assert_ptr_eq(map, untouched);
    for (size_t size = 0; size <= strlen(text) + 1; size++)
    {
        char cut[sizeof text];
        memset(cut, 'x', sizeof cut);
        ck_assert_int_eq(cm_colormap_check(specification, cut, size), status);
        ck_assert(size == 0 || strlen(cut) == (size <= strlen(text) ? size - 1 : strlen(text)));
        ck_assert(size == 0 || strncmp(cut, text, size - 1) == 0);
        ck_assert_int_eq(cut[size], 'x');
    }
    ck_assert_int_eq(cm_colormap_check(specification, NULL, 0), status);
}

#define KNOWN                                                                                      \
    "; there are sequential-single, sequential-rainbow, sequential-custom, "                       \
    "sequential-saturation, diverging-lightness, diverging-saturation, qualitative, "              \
    "uniform-purple-yellow, uniform-red-yellow, uniform-blue, uniform-green, uniform-blue-red, "   \
    "uniform-purple-green, uniform-cyclic"
#define HAS "; it has hue, divergence, lightness, saturation"

START_TEST(wrong_specifications)
{
    expect_error("", CM_ERROR_SYNTAX, "no colour map is called ''" KNOWN);
    expect_error("viridis", CM_ERROR_MAPPING, "no colour map is called 'viridis'" KNOWN);
    expect_error("a\nb:", CM_ERROR_MAPPING, "no colour map is called 'a?b'" KNOWN);
    expect_error("qualitative:", CM_ERROR_SYNTAX,
                 "'' is not PARAMETER=VALUE; qualitative has hue, divergence, lightness, "
                 "saturation");
    expect_error("qualitative:hue=1,", CM_ERROR_SYNTAX,
                 "'' is not PARAMETER=VALUE; qualitative has hue, divergence, lightness, "
                 "saturation");
    expect_error("qualitative:hues=1", CM_ERROR_PARAMETER,
                 "qualitative has no parameter 'hues'" HAS);
    expect_error("qualitative:hu=1", CM_ERROR_PARAMETER, "qualitative has no parameter 'hu'" HAS);
    expect_error("qualitative:=1", CM_ERROR_PARAMETER, "qualitative has no parameter ''" HAS);
    expect_error("qualitative:hue=1,HUE=1", CM_ERROR_PARAMETER,
                 "parameter hue of qualitative is given twice");
    expect_error("uniform-blue:saturation=1", CM_ERROR_PARAMETER,
                 "uniform-blue has no parameters, so 'saturation=1' is too much");
    static const char *const no_numbers[] = {"",   "-",   ".",    "e5",   "1e",  "1e+", "1 ", " 1",
                                             "1x", "0x1", "1..2", "1.2.", "nan", "inf", "--1"};
    for (size_t i = 0; i < sizeof no_numbers / sizeof no_numbers[0]; i++)
    {
        char text[100], message[100];
        snprintf(text, sizeof text, "qualitative:hue=%s", no_numbers[i]);
        snprintf(message, sizeof message, "'%s' is not a number for parameter hue of qualitative",
                 no_numbers[i]);
        expect_error(text, CM_ERROR_SYNTAX, message);
    }
    expect_error("qualitative:hue=361", CM_ERROR_RANGE,
                 "parameter hue of qualitative is 361; it must be in [0, 360]");
    expect_error("qualitative:hue=-1e-300", CM_ERROR_RANGE,
                 "parameter hue of qualitative is -1e-300; it must be in [0, 360]");
    expect_error("qualitative:saturation=1e999", CM_ERROR_RANGE,
                 "parameter saturation of qualitative is 1e999; it must be in [0, 5]");
    expect_error("single:lightness-range=0.5", CM_ERROR_RANGE,
                 "parameter lightness-range of sequential-single is 0.5; it must be in (0.5, 1]");
}
END_TEST

START_TEST(wrong_stops)
{
    expect_error("custom:hues=", CM_ERROR_SYNTAX,
                 "'' is not a number for parameter hues of sequential-custom");
    expect_error("custom:hues=1/", CM_ERROR_SYNTAX,
                 "'' is not a number for parameter hues of sequential-custom");
    expect_error("custom:hues=1@", CM_ERROR_SYNTAX,
                 "'' is not a number for a place in parameter hues of sequential-custom");
    expect_error("custom:hues=400", CM_ERROR_RANGE,
                 "parameter hues of sequential-custom is 400; it must be in [0, 360]");
    expect_error("custom:hues=4@1.1", CM_ERROR_RANGE,
                 "a place in parameter hues of sequential-custom is 1.1; it must be in [0, 1]");
    expect_error("custom:hues=4@0.5/5@0.5", CM_ERROR_RANGE,
                 "the places of parameter hues of sequential-custom must grow, but 0.5 is not "
                 "above the one before");
    expect_error("custom:hues=4@0.5/5", CM_ERROR_SYNTAX,
                 "of the stops of parameter hues of sequential-custom either all have a place, as "
                 "in 90@0.5, or none");
    expect_error("custom:hues=1/2/3/4/5/6/7/8/9/10/11/12/13/14/15/16/17", CM_ERROR_RANGE,
                 "parameter hues of sequential-custom has more than 16 stops");
    cm_colormap_destroy(make("custom:hues=1/2/3/4/5/6/7/8/9/10/11/12/13/14/15/16"));
}
END_TEST

START_TEST(missing_arguments)
{
    cm_colormap *map = NULL;
    char message[100];
    ck_assert_int_eq(cm_colormap_check(NULL, message, sizeof message), CM_ERROR_ARGUMENT);
    ck_assert_str_eq(message, "no colour map is given");
    ck_assert_int_eq(cm_colormap_create(NULL, &map), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_colormap_create("single", NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_colormap_fit(NULL, &map), CM_ERROR_ARGUMENT);
    ck_assert_ptr_null(map);
    map = make("single");
    ck_assert_int_eq(cm_colormap_fit(map, NULL), CM_ERROR_ARGUMENT);
    cm_colormap_destroy(map);
}
END_TEST

static void expect_value(const char *text, double expected)
{
    char specification[200];
    snprintf(specification, sizeof specification, "Qualitative:HUE=%s", text);
    cm_colormap *map = make(specification);
    REQUIRE(cm_colormap_parameter(map, 0) == expected, "%s is %.17g, not %.17g", text,
            cm_colormap_parameter(map, 0), expected);
    ck_assert(!signbit(cm_colormap_parameter(map, 0)));
    cm_colormap_destroy(map);
}

START_TEST(numbers)
{
    expect_value("12", 12.0);
    expect_value("+12.5", 12.5);
    expect_value(".5", 0.5);
    expect_value("5.", 5.0);
    expect_value("1.25e2", 125.0);
    expect_value("1.25E+02", 125.0);
    expect_value("125e-2", 1.25);
    expect_value("-0", 0.0);
    expect_value("-0.0e5", 0.0);
    expect_value("1e-400", 0.0);
    expect_value("0.1", 0.1);
    expect_value("123.4567890123456789", 123.4567890123456789);
    expect_value("0.30000000000000004440892098500626", 0.1 + 0.2);
}
END_TEST

START_TEST(stops)
{
    double stop[2];
    cm_colormap *map = make("custom:hues=10/350/90/1");
    ck_assert_uint_eq(cm_colormap_stop_count(map), 4);
    cm_colormap_stop(map, 1, stop);
    ck_assert_double_eq(stop[0], 1.0 / 3.0);
    ck_assert_double_eq(stop[1], 350.0);
    cm_colormap_stop(map, 3, stop);
    ck_assert_double_eq(stop[0], 1.0);
    cm_colormap_stop(map, 4, stop);
    ck_assert(isnan(stop[0]) && isnan(stop[1]));
    cm_colormap_destroy(map);
    map = make("qualitative");
    ck_assert_uint_eq(cm_colormap_stop_count(map), 0);
    cm_colormap_destroy(map);
}
END_TEST

START_TEST(specifications_come_back)
{
    for_many_maps(60, make, check_specification);
}
END_TEST

/* Only where the machine has such a locale. */
START_TEST(a_point_in_every_locale)
{
    static const char *const commas[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"};
    for (size_t i = 0; i < sizeof commas / sizeof commas[0]; i++)
    {
        if (setlocale(LC_ALL, commas[i]) != NULL)
        {
            expect_value("12.5", 12.5);
            cm_colormap *map = make("qualitative:hue=12.5");
            check_specification(map, "in a locale with a comma");
            cm_colormap_destroy(map);
            setlocale(LC_ALL, "C");
        }
    }
}
END_TEST

/* ---------------------------------------------------------------- memory */

#ifdef WRAPS_MALLOC
START_TEST(without_memory)
{
    cm_colormap *map = make("rainbow");
    cm_colormap *untouched = map;
    exhausted = 1;
    cm_status status = cm_colormap_create("single", &untouched);
    cm_status status_of_fit = cm_colormap_fit(map, &untouched);
    exhausted = 0;
    ck_assert_int_eq(status, CM_ERROR_MEMORY);
    ck_assert_int_eq(status_of_fit, CM_ERROR_MEMORY);
    ck_assert_ptr_eq(untouched, map);
    cm_colormap_destroy(map);
}
END_TEST
#endif

int main(void)
{
    const TTest *const tests[] = {catalogue,
                                  standard_maps,
                                  wrong_specifications,
                                  wrong_stops,
                                  missing_arguments,
                                  numbers,
                                  stops,
                                  specifications_come_back,
                                  a_point_in_every_locale,
#ifdef WRAPS_MALLOC
                                  without_memory,
#endif
                                  NULL};
    return run_suite("colormap", tests);
}
