/* SPDX-License-Identifier: MIT
 *
 * Colour maps. What they promise is measured from their sRGB values, by conversions of the tests' own.
 */
#define _POSIX_C_SOURCE 200809L

#include <cubemap/colormap.h>

#include <locale.h>

#include "own_colors.h"
#include "tests/suite.h"

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

/* ---------------------------------------------------------------- maps */

static cm_colormap *make(const char *specification)
{
    cm_colormap *map = NULL;
    char message[400] = "";
    cm_colormap_check(specification, message, sizeof message);
    REQUIRE(cm_colormap_create(specification, &map) == CM_OK, "%s: %s", specification, message);
    return map;
}

static cm_colormap *make_fitted(const char *specification)
{
    cm_colormap *map = make(specification);
    cm_colormap *fitted = NULL;
    REQUIRE(cm_colormap_fit(map, &fitted) == CM_OK, "%s", specification);
    cm_colormap_destroy(map);
    return fitted;
}

static cm_colormap_color color_at(const cm_colormap *map, double t)
{
    cm_colormap_color color;
    cm_colormap_color_at(map, t, &color);
    return color;
}

static int is_uniform(const cm_colormap *map)
{
    return cm_colormap_describe(map)->space == CM_COLORMAP_CAM16_UCS;
}

/* In the space of the map. */
static void own_point(const cm_colormap *map, const double srgb[3], double point[3])
{
    (is_uniform(map) ? own_ucs : own_luv)(srgb, point);
}

static double parameter(const cm_colormap *map, const char *name)
{
    const cm_colormap_info *info = cm_colormap_describe(map);
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        if (strcmp(info->parameter[i].name, name) == 0)
        {
            return cm_colormap_parameter(map, i);
        }
    }
    return (double)NAN;
}

/* The same numbers in every run. */
static uint64_t state = 1;

static double uniform(double low, double high)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) * 0x1p-53;
}

/* A specification with parameters from all over their ranges; now and then at their ends. */
static void any_specification(const cm_colormap_info *info, char *text, size_t size)
{
    int length = snprintf(text, size, "%s", info->identifier);
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        const cm_colormap_parameter_info *p = &info->parameter[i];
        double value = uniform(0.0, 1.0) < 0.1 ? p->high : uniform(p->low, p->high);
        value = p->low_excluded && value <= p->low + 1e-3 ? p->low + 1e-3 : value;
        length += snprintf(text + length, size - (size_t)length, "%c%s=%.17g", i == 0 ? ':' : ',',
                           p->name, value);
        for (int k = (int)uniform(0.0, 7.0); p->stops != NULL && k > 0; k--)
        {
            length += snprintf(text + length, size - (size_t)length, "/%.17g", uniform(0.0, 360.0));
        }
    }
}

/* Call check for every model with standard parameters, and with others, so many of each. */
static void for_many_maps(int others, cm_colormap *(*maker)(const char *),
                          void (*check)(const cm_colormap *, const char *))
{
    for (size_t i = 0; i < cm_colormap_count(); i++)
    {
        const int more = cm_colormap_at(i)->parameter_count > 0 ? others : 0;
        for (int k = 0; k <= more; k++)
        {
            char text[600];
            snprintf(text, sizeof text, "%s", cm_colormap_at(i)->identifier);
            if (k > 0)
            {
                any_specification(cm_colormap_at(i), text, sizeof text);
            }
            cm_colormap *map = maker(text);
            check(map, text);
            cm_colormap_destroy(map);
        }
    }
}

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

/* The map of its own specification has the same bits. */
static void check_specification(const cm_colormap *map, const char *text)
{
    char written[1024], cut[1024];
    size_t length = cm_colormap_specification(map, written, sizeof written);
    ck_assert_uint_eq(length, strlen(written));
    ck_assert_uint_eq(cm_colormap_specification(map, NULL, 0), length);
    for (size_t size = 1; size < length + 3; size += 7)
    {
        memset(cut, 'x', sizeof cut);
        ck_assert_uint_eq(cm_colormap_specification(map, cut, size), length);
        ck_assert_uint_eq(strlen(cut), size <= length ? size - 1 : length);
        ck_assert_int_eq(strncmp(cut, written, size - 1), 0);
        ck_assert_int_eq(cut[size], 'x');
    }
    cm_colormap *again = make(written);
    for (int i = 0; i <= 50; i++)
    {
        cm_colormap_color a = color_at(map, i / 50.0);
        cm_colormap_color b = color_at(again, i / 50.0);
        REQUIRE(memcmp(a.lch, b.lch, sizeof a.lch) == 0 &&
                    memcmp(a.srgb, b.srgb, sizeof a.srgb) == 0,
                "%s and %s differ", text, written);
    }
    cm_colormap_destroy(again);
}

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

/* ---------------------------------------------------------------- conversions */

START_TEST(known_colors)
{
    /* computed with 30 digits from the chromaticities of IEC 61966-2-1 */
    static const double known[][2][3] = {
        {{1.0, 0.0, 0.0}, {53.237115595429, 175.00982216288, 37.765093625560}},
        {{0.0, 1.0, 0.0}, {87.735519109660, -83.067119714401, 107.41811123934}},
        {{0.0, 0.0, 1.0}, {32.300872903980, -9.4024072148241, -130.35108850356}},
        {{1.0, 1.0, 0.0}, {97.138559341797, 7.7042191772699, 106.80811125090}},
        {{0.0, 1.0, 1.0}, {91.114752316705, -70.464379963878, -15.205397466927}},
        {{1.0, 0.0, 1.0}, {60.322731354551, 84.055601989752, -108.69636549177}},
        {{1.0, 1.0, 1.0}, {100.0, 0.0, 0.0}},
        {{0.5, 0.5, 0.5}, {53.388964741114, 0.0, 0.0}},
        {{0.2, 0.4, 0.6}, {42.009163494482, -20.244149803300, -47.559331810386}},
        {{0.01, 0.02, 0.03}, {1.3000987749436, -0.44226033877491, -0.64193295903125}},
        {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
    {
        double linear[3], luv[3], own[3], srgb[3];
        cm_colormap_linear_from_srgb(known[i][0], linear);
        cm_colormap_luv_from_linear(linear, luv);
        own_luv(known[i][0], own);
        REQUIRE(distance(luv, known[i][1]) < 1e-10, "%zu: %.14g %.14g %.14g", i, luv[0], luv[1],
                luv[2]);
        REQUIRE(distance(own, known[i][1]) < 1e-10, "the test's own: %zu", i);
        cm_colormap_linear_from_luv(known[i][1], linear);
        cm_colormap_srgb_from_linear(linear, srgb);
        REQUIRE(distance(srgb, known[i][0]) < 1e-12, "%zu: %.14g %.14g %.14g", i, srgb[0], srgb[1],
                srgb[2]);
    }
}
END_TEST

/* With the matrix in the rounding of B. Lindbloom and the white 0.95047, 1, 1.08883, as many programs
 * have them, red is 53.2408, 175.0151, 37.7564. */
START_TEST(red_of_other_programs)
{
    const double red[3] = {1.0, 0.0, 0.0};
    const double others[3] = {53.2408, 175.0151, 37.7564};
    double luv[3];
    cm_colormap_luv_from_linear(red, luv);
    ck_assert_double_lt(distance(luv, others), 0.02);
}
END_TEST

/* The matrix is the one that the standard prints with four digits. */
START_TEST(printed_matrix)
{
    static const double printed[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    double matrix[3][3];
    derive_matrix(matrix);
    for (int k = 0; k < 9; k++)
    {
        ck_assert_double_eq_tol(matrix[k / 3][k % 3], printed[k / 3][k % 3], 0.5e-4);
    }
}
END_TEST

START_TEST(conversions_come_back)
{
    double worst = 0.0;
    for (int i = 0; i < 33 * 33 * 33; i++)
    {
        const double srgb[3] = {i % 33 / 32.0, i / 33 % 33 / 32.0, i / 1089 / 32.0};
        double linear[3], luv[3], lch[3], again[3], own[3], back[3];
        cm_colormap_linear_from_srgb(srgb, linear);
        cm_colormap_luv_from_linear(linear, luv);
        own_luv(srgb, own);
        cm_colormap_lch_from_luv(luv, lch);
        ck_assert(lch[1] >= 0.0 && lch[2] >= 0.0 && lch[2] < 360.0);
        cm_colormap_luv_from_lch(lch, again);
        cm_colormap_linear_from_luv(again, linear);
        cm_colormap_srgb_from_linear(linear, back);
        REQUIRE(distance(luv, own) < 1e-10 && distance(luv, again) < 1e-10 &&
                    distance(srgb, back) < 1e-12,
                "%g %g %g: %g %g %g", srgb[0], srgb[1], srgb[2], distance(luv, own),
                distance(luv, again), distance(srgb, back));
        cm_colormap_linear_from_srgb(back, linear);
        cm_colormap_luv_from_linear(linear, again);
        worst = fmax(worst, distance(luv, again));
    }
    REQUIRE(worst < 1e-10, "%g", worst);
}
END_TEST

/* Around the joint of the transfer function, where printed constants leave a step of 3e-8. */
START_TEST(transfer_function_has_an_inverse)
{
    double before = -1.0;
    for (int i = -20000; i <= 20000; i++)
    {
        const double linear[3] = {0.0031307 + i * 1e-11, -(0.0031307 + i * 1e-11), i / 20000.0};
        double srgb[3], back[3];
        cm_colormap_srgb_from_linear(linear, srgb);
        cm_colormap_linear_from_srgb(srgb, back);
        ck_assert_double_lt(distance(linear, back), 1e-15);
        ck_assert_double_eq(srgb[0], -srgb[1]);
        REQUIRE(srgb[0] >= before, "falls at %.17g", linear[0]);
        before = srgb[0];
    }
}
END_TEST

static int all_nan(const double values[3])
{
    return isnan(values[0]) && isnan(values[1]) && isnan(values[2]);
}

START_TEST(no_colors)
{
    const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (int i = 0; i < 9; i++)
    {
        double values[3] = {50.0, 1.0, 1.0}, result[3];
        values[i % 3] = bad[i / 3];
        cm_colormap_linear_from_luv(values, result);
        REQUIRE(all_nan(result), "linear_from_luv %d", i);
        cm_colormap_luv_from_linear(values, result);
        REQUIRE(all_nan(result), "luv_from_linear %d", i);
        cm_colormap_srgb_from_linear(values, result);
        ck_assert_double_nan(result[i % 3]);
        cm_colormap_linear_from_srgb(values, result);
        ck_assert_double_nan(result[i % 3]);
    }
    double result[3];
    cm_colormap_linear_from_luv((const double[3]){-1.0, 0.0, 0.0}, result);
    ck_assert(all_nan(result));
    cm_colormap_linear_from_luv((const double[3]){50.0, 0.0, -1000.0}, result);
    ck_assert(all_nan(result)); /* v' < 0 */
    cm_colormap_luv_from_linear((const double[3]){-1.0, 0.0, 0.0}, result);
    ck_assert(all_nan(result));
    cm_colormap_linear_from_luv((const double[3]){0.0, 5.0, 7.0}, result);
    ck_assert(result[0] == 0.0 && result[1] == 0.0 && result[2] == 0.0);
}
END_TEST

/* ---------------------------------------------------------------- constant speed */

static int crosses_corner(const cm_colormap *map, double from, double to)
{
    for (size_t i = 0; i < cm_colormap_corner_count(map); i++)
    {
        if (cm_colormap_corner(map, i) > from && cm_colormap_corner(map, i) < to)
        {
            return 1;
        }
    }
    return 0;
}

static double worst_step;

/* All steps of 20001 samples, as parts of the length that t says is between them; across a corner they are
 * shorter than that. */
static void check_steps(const cm_colormap *map, const char *text)
{
    const size_t n = 20001;
    double *srgb = malloc(3 * n * sizeof *srgb);
    double mean = cm_colormap_length(map) / (double)(n - 1);
    double sum = 0.0;
    ck_assert_ptr_nonnull(srgb);
    ck_assert(cm_colormap_inside(map));
    cm_colormap_samples(map, n, srgb, NULL);
    double before[3], here[3];
    own_point(map, srgb, before);
    for (size_t i = 1; i < n; i++)
    {
        double from = cm_colormap_position(map, n, i - 1), to = cm_colormap_position(map, n, i);
        double even = mean * (to - from) * (double)(n - 1);
        own_point(map, srgb + 3 * i, here);
        double step = distance(before, here);
        double deviation = fabs(step / even - 1.0);
        int corner = crosses_corner(map, from, to);
        REQUIRE(step < even * (1.0 + 1e-6) + 1e-11 && (corner || deviation < 1e-6),
                "%s: step %zu is off by %g", text, i, deviation);
        worst_step = corner ? worst_step : fmax(worst_step, deviation);
        sum += step;
        memcpy(before, here, sizeof here);
    }
    REQUIRE(fabs(sum / cm_colormap_position(map, n, n - 1) - mean * (double)(n - 1)) <
                3e-4 * sum + 1e-9,
            "%s: %g", text, sum);
    free(srgb);
}

START_TEST(standard_maps_have_constant_speed)
{
    for_many_maps(0, make, check_steps);
    printf("standard maps, steps of 20001 samples: worst deviation %.3g\n", worst_step);
}
END_TEST

/* Differences between places so close that neither the path's curvature nor rounding matters. */
static void check_speed(const cm_colormap *map, const char *text)
{
    const double dt = 2e-6;
    double length = cm_colormap_length(map);
    for (int i = 0; i < 500; i++)
    {
        double t = uniform(0.0, 1.0 - dt), from[3], to[3];
        if (crosses_corner(map, t, t + dt) || length < 1.0)
        {
            continue;
        }
        own_point(map, color_at(map, t).srgb, from);
        own_point(map, color_at(map, t + dt).srgb, to);
        double deviation = fabs(distance(from, to) / (length * dt) - 1.0);
        REQUIRE(deviation < 1e-6, "%s: t = %.17g, speed is off by %g", text, t, deviation);
        worst_step = fmax(worst_step, deviation);
    }
}

START_TEST(other_maps_have_constant_speed)
{
    state = 2;
    worst_step = 0.0;
    for_many_maps(60, make_fitted, check_speed);
    printf("other maps, speed: worst deviation %.3g\n", worst_step);
}
END_TEST

/* In the space of the map, from before the colour became sRGB. */
static void path_point(const cm_colormap *map, const cm_colormap_color *color, double point[3])
{
    if (is_uniform(map))
    {
        cm_colormap_ucs_from_linear(color->linear, point);
    }
    else
    {
        memcpy(point, color->luv, sizeof color->luv);
    }
}

/* A difference quotient of fourth order. */
static void check_speed_closely(const cm_colormap *map, const char *text)
{
    const double h = 1e-4;
    double length = cm_colormap_length(map);
    for (int i = 3; i < 9997; i += (int)long_step_of(4, 20))
    {
        double t = i / 1e4, velocity[3], at[4][3];
        if (crosses_corner(map, t - 3.0 * h, t + 3.0 * h))
        {
            continue;
        }
        for (int k = 0; k < 4; k++)
        {
            cm_colormap_color color = color_at(map, t + h * (k < 2 ? k - 2 : k - 1));
            path_point(map, &color, at[k]);
        }
        for (int k = 0; k < 3; k++)
        {
            velocity[k] = (8.0 * (at[2][k] - at[1][k]) - (at[3][k] - at[0][k])) / (12.0 * h);
        }
        double speed =
            sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2]);
        double deviation = fabs(speed / length - 1.0);
        REQUIRE(deviation < 1e-9, "%s: t = %.17g, speed is off by %g", text, t, deviation);
        worst_step = fmax(worst_step, deviation);
    }
}

START_TEST(the_speed_is_constant_to_nine_digits)
{
    worst_step = 0.0;
    for_many_maps(0, make, check_speed_closely);
    printf("standard maps, speed: worst deviation %.3g\n", worst_step);
}
END_TEST

/* Out of the gamut sRGB goes below 0, where the conversion back is another one: from LUV. */
static void check_luv_speed(const cm_colormap *map, const char *text)
{
    const double dt = 2e-6;
    double length = cm_colormap_length(map);
    for (int i = 0; i < 500 && length >= 1.0; i++)
    {
        double t = uniform(0.0, 1.0 - dt);
        cm_colormap_color from = color_at(map, t), to = color_at(map, t + dt);
        double start[3], end[3];
        path_point(map, &from, start);
        path_point(map, &to, end);
        double deviation = fabs(distance(start, end) / (length * dt) - 1.0);
        REQUIRE(crosses_corner(map, t, t + dt) || deviation < 1e-6, "%s: t = %.17g, off by %g",
                text, t, deviation);
    }
}

START_TEST(maps_out_of_gamut_have_constant_speed)
{
    state = 3;
    for_many_maps(60, make, check_luv_speed);
}
END_TEST

/* ---------------------------------------------------------------- even steps */

static double hue_difference(double a, double b)
{
    return fabs(remainder(a - b, 360.0));
}

/* What is known of the samples of one map. */
typedef struct sampled
{
    size_t n;
    double *t;
    double (*point)[3]; /* from their sRGB, in the space of the map */
    size_t fold_count;
    double fold[CM_COLORMAP_STOPS_MAX + 2];
} sampled;

static sampled sample(const cm_colormap *map, size_t n)
{
    sampled s = {.n = n, .t = malloc(n * sizeof *s.t), .point = malloc(n * sizeof *s.point)};
    double *srgb = malloc(3 * n * sizeof *srgb);
    ck_assert(srgb != NULL && s.t != NULL && s.point != NULL);
    cm_colormap_samples(map, n, srgb, NULL);
    for (size_t i = 0; i < n; i++)
    {
        s.t[i] = cm_colormap_position(map, n, i);
        own_point(map, srgb + 3 * i, s.point[i]);
    }
    free(srgb);
    return s;
}

static void forget(sampled *s)
{
    free(s->t);
    free(s->point);
}

/* The angle in degrees by which the path turns at a corner: from 0 for straight on to 180 for back. */
static double turn_at(const cm_colormap *map, double corner)
{
    const double h = 1e-6;
    double at[3][3];
    for (int i = 0; i < 3; i++)
    {
        own_point(map, color_at(map, corner + (i - 1) * h).srgb, at[i]);
    }
    double product = 0.0;
    for (int k = 0; k < 3; k++)
    {
        product += (at[1][k] - at[0][k]) * (at[2][k] - at[1][k]);
    }
    product /= distance(at[0], at[1]) * distance(at[1], at[2]);
    return acos(fmin(fmax(product, -1.0), 1.0)) * 180.0 / PI;
}

/* Are the corners so far apart that even steps are promised? Folds that are passed over, or may be, are
 * listed. */
static int has_room(const cm_colormap *map, sampled *s)
{
    const size_t count = cm_colormap_corner_count(map);
    const double steps = (double)(s->n - 1);
    int room = 1;
    s->fold_count = 0;
    for (size_t i = 0; i < count; i++)
    {
        double corner = cm_colormap_corner(map, i);
        double before = i == 0 ? corner : corner - cm_colormap_corner(map, i - 1);
        double behind = i + 1 == count ? 1.0 - corner : cm_colormap_corner(map, i + 1) - corner;
        double turn = turn_at(map, corner);
        room = room && before * steps >= (i == 0 ? 2.0 : 4.0) &&
               behind * steps >= (i + 1 == count ? 2.0 : 4.0);
        if (turn > 149.99 &&
            steps * fmin(before, behind) * sin(turn * PI / 180.0) < 16.0 * (1.0 + 1e-4))
        {
            s->fold[s->fold_count++] = corner;
        }
    }
    return room;
}

/* Is there a fold between these samples? */
static int is_folded(const sampled *s, size_t i)
{
    for (size_t k = 0; k < s->fold_count; k++)
    {
        if (s->t[i] <= s->fold[k] && s->fold[k] <= s->t[i + 1])
        {
            return 1;
        }
    }
    return 0;
}

/* How far the hue goes round between two samples, at most, corners left out. Of uniform maps that says nothing:
 * close to grey it goes round without much of a way; only what holds of all maps is asked of them. */
static double widest_turn(const cm_colormap *map, const sampled *s)
{
    double widest = is_uniform(map) ? 15.0 : 0.0;
    for (size_t i = 0; i + 1 < s->n; i++)
    {
        double here = color_at(map, s->t[i]).lch[2], next = color_at(map, s->t[i + 1]).lch[2];
        /* with as much round the other way it is no small turn either */
        double middle = color_at(map, 0.5 * (s->t[i] + s->t[i + 1])).lch[2];
        double turn = hue_difference(here, middle) + hue_difference(middle, next);
        /* what begins or ends on a corner is a hair away from it, too */
        if (!is_uniform(map) && !crosses_corner(map, s->t[i] - 1e-12, s->t[i + 1] + 1e-12))
        {
            widest = fmax(widest, turn);
        }
    }
    return widest;
}

static double worst_even, worst_gentle;
static size_t even_count, fold_count;
static const size_t *even_sizes;

/* All steps, corners included, are close to the mean. */
static void check_even(const cm_colormap *map, const sampled *s, const char *text)
{
    double sum = 0.0, count = 0.0, turn = widest_turn(map, s);
    if (turn > 20.0)
    {
        return;
    }
    for (size_t i = 0; i + 1 < s->n; i++)
    {
        sum += is_folded(s, i) ? 0.0 : distance(s->point[i], s->point[i + 1]);
        count += !is_folded(s, i);
    }
    for (size_t i = 0; i + 1 < s->n; i++)
    {
        double deviation = fabs(distance(s->point[i], s->point[i + 1]) * count / sum - 1.0);
        if (is_folded(s, i))
        {
            fold_count++;
            continue;
        }
        REQUIRE(deviation < 0.02, "%s: step %zu of %zu, from t = %.17g, is off by %g %%", text, i,
                s->n - 1, s->t[i], 100.0 * deviation);
        REQUIRE(turn > 10.0 || deviation < 0.006,
                "%s: step %zu of %zu, from t = %.17g, is off by %g %%", text, i, s->n - 1, s->t[i],
                100.0 * deviation);
        worst_even = fmax(worst_even, deviation);
        worst_gentle = turn > 10.0 ? worst_gentle : fmax(worst_gentle, deviation);
    }
    even_count++;
}

/* Places grow, begin and end where they should, and those of a diverging map are mirror images. */
static void check_places(const cm_colormap *map, const sampled *s, const char *text)
{
    const int diverging = cm_colormap_describe(map)->family == CM_COLORMAP_DIVERGING;
    const size_t last = s->n - 1;
    ck_assert(s->t[0] == 0.0);
    REQUIRE(cm_colormap_describe(map)->family == CM_COLORMAP_CYCLIC
                ? s->t[last] == (double)last / (double)s->n
                : s->t[last] == 1.0 || cm_colormap_describe(map)->family == CM_COLORMAP_QUALITATIVE,
            "%s: %zu samples end at %.17g", text, s->n, s->t[last]);
    for (size_t i = 0; i < last; i++)
    {
        REQUIRE(s->t[i + 1] > s->t[i], "%s: place %zu of %zu does not grow", text, i + 1, s->n);
        REQUIRE(!diverging || fabs(s->t[i] + s->t[last - i] - 1.0) < 1e-15,
                "%s: places %zu and %zu of %zu", text, i, last - i, s->n);
    }
    if (diverging && s->n % 2 == 1)
    {
        cm_colormap_color middle = color_at(map, s->t[last / 2]);
        const double grey = is_uniform(map) ? 1e-9 : 0.0;
        ck_assert(s->t[last / 2] == 0.5 && middle.lch[1] <= grey && fabs(middle.luv[1]) <= grey);
    }
}

static void check_evenness(const cm_colormap *map, const char *text)
{
    for (const size_t *n = even_sizes; *n > 0; n++)
    {
        sampled s = sample(map, *n);
        check_places(map, &s, text);
        if (has_room(map, &s) && cm_colormap_length(map) >= 1.0)
        {
            check_even(map, &s, text);
        }
        forget(&s);
    }
}

static void require_evenness(const char *what, const size_t *sizes, int others, size_t least)
{
    even_sizes = sizes;
    even_count = fold_count = 0;
    worst_even = worst_gentle = 0.0;
    for_many_maps(others, make_fitted, check_evenness);
    printf("%s: %zu times even, worst step %.3g %% off, with hues of up to 10 degrees %.3g %%; "
           "%zu folds\n",
           what, even_count, 100.0 * worst_even, 100.0 * worst_gentle, fold_count);
    REQUIRE(even_count >= least, "only %zu", even_count);
}

/* None is left out: the promise of 2 % begins with 20, of 0.5 % with 28, of 0.1 % with 64. */
START_TEST(samples_of_standard_maps_are_even)
{
    static const size_t few[] = {20, 21, 22, 23, 24, 25, 26, 27, 0};
    static const size_t more[] = {28, 29, 30, 31, 32, 33, 40, 41, 50, 63, 0};
    static const size_t many[] = {64, 65, 100, 101, 127, 128, 255, 256, 257, 512, 1000, 4096, 0};
    const size_t maps = cm_colormap_count();
    require_evenness("standard maps, from 20 samples", few, 0, 8 * maps);
    require_evenness("standard maps, from 28 samples", more, 0, 10 * maps);
    ck_assert_double_lt(worst_even, 0.005);
    require_evenness("standard maps, from 64 samples", many, 0, 12 * maps);
    ck_assert_double_lt(worst_even, 0.001);
    ck_assert_uint_eq(fold_count, 0);
}
END_TEST

START_TEST(samples_of_other_maps_are_even)
{
    static const size_t sizes[] = {33, 64, 100, 255, 256, 257, 1000, 0};
    state = 9;
    const int others = is_long() ? 24 : is_quick() ? 6 : 10;
    require_evenness("other maps", sizes, others, (size_t)others * 33);
}
END_TEST

/* A corner is as even as the rest, whatever its phase: with n the samples beside it wander. */
START_TEST(samples_are_even_with_every_number)
{
    size_t sizes[400];
    size_t count = 0;
    for (size_t n = 28; n < 427; n += long_step_of(7, 9))
    {
        sizes[count++] = n;
    }
    sizes[count] = 0;
    require_evenness("standard maps, from 28 to 426 samples", sizes, 0,
                     count * cm_colormap_count());
    ck_assert_double_lt(worst_even, 0.005);
}
END_TEST

static void check_few(const cm_colormap *map, const char *text)
{
    for (size_t n = 2; n < 20; n += step_of(3))
    {
        sampled s = sample(map, n);
        check_places(map, &s, text);
        forget(&s);
    }
}

/* Where corners have no room, in the gamut and out of it. */
START_TEST(places_of_few_samples)
{
    state = 11;
    for_many_maps(is_long() ? 60 : 20, make, check_few);
}
END_TEST

static size_t crowded_count;

static void check_crowd(const cm_colormap *map, const char *text)
{
    static const size_t sizes[] = {9, 33, 400};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
    {
        sampled s = sample(map, sizes[i]);
        double mean = cm_colormap_length(map) / (double)(s.n - 1), least = mean;
        check_places(map, &s, text);
        has_room(map, &s);
        for (size_t k = 0; k + 1 < s.n; k++)
        {
            least = is_folded(&s, k) ? least : fmin(least, distance(s.point[k], s.point[k + 1]));
        }
        crowded_count += s.n == 400 && least > 0.97 * mean;
        forget(&s);
    }
}

/* With many stops whose hues go to and fro places are hard to find; nearly always they are. */
START_TEST(samples_of_many_stops)
{
    const int count = 10;
    state = 10;
    crowded_count = 0;
    for (int i = 0; i < count; i++)
    {
        char text[600];
        int length = snprintf(text, sizeof text, "custom:saturation=%.17g,hues=%.17g",
                              uniform(0.3, 2.0), uniform(0.0, 360.0));
        for (int k = 9 + i % 7; k > 0; k--)
        {
            length += snprintf(text + length, sizeof text - (size_t)length, "/%.17g",
                               uniform(0.0, 360.0));
        }
        cm_colormap *map = make_fitted(text);
        check_crowd(map, text);
        cm_colormap_destroy(map);
    }
    printf("many stops: 400 samples are even in %zu of %d maps\n", crowded_count, count);
    ck_assert_uint_ge(crowded_count, (size_t)count * 9 / 10);
}
END_TEST

static void expect_even_places(const cm_colormap *map, size_t n)
{
    for (size_t i = 0; i < n; i++)
    {
        double wanted = (double)i / (double)(n - 1);
        REQUIRE(fabs(cm_colormap_position(map, n, i) - wanted) < 1e-15, "%zu of %zu is %.17g", i, n,
                cm_colormap_position(map, n, i));
    }
}

/* Where there is no corner, no room, or nothing but a fold, places are i / (n - 1). */
START_TEST(places_without_corners)
{
    static const char *const maps[] = {"saturation",
                                       "diverging-saturation:divergence=180",
                                       "diverging-saturation:divergence=180.00001",
                                       "diverging-saturation:divergence=0",
                                       "diverging-saturation:saturation=0",
                                       "qualitative:divergence=120",
                                       "qualitative:lightness=0,divergence=120",
                                       "custom:hues=0@0.5/0.1@0.5001/0.1@0.5002/0.3@0.5003"};
    static const size_t sizes[] = {2, 3, 4, 33, 256, 257};
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++)
    {
        cm_colormap *map = make(maps[i]);
        for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++)
        {
            expect_even_places(map, sizes[k]);
        }
        ck_assert_double_eq(cm_colormap_position(map, 1, 0), 0.0);
        cm_colormap_destroy(map);
    }
}
END_TEST

/* Numbers that no array has; nothing traps, and places stay in order. */
START_TEST(places_of_enormous_numbers)
{
    static const size_t sizes[] = {(size_t)1 << 31, SIZE_MAX};
    for (size_t i = 0; i < cm_colormap_count(); i++)
    {
        cm_colormap *map = make(cm_colormap_at(i)->identifier);
        for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++)
        {
            size_t n = sizes[k];
            double before = -1.0;
            for (size_t part = 0; part <= 16; part++)
            {
                double t = cm_colormap_position(map, n, (n - 1) / 16 * part);
                REQUIRE(t > before && t <= 1.0, "%zu of %zu: %.17g", part, n, t);
                before = t;
            }
        }
        cm_colormap_destroy(map);
    }
}
END_TEST

/* ---------------------------------------------------------------- the paths of the paper */

/* The hue of a list of stops at a place, the shorter way. */
static double stop_hue(const cm_colormap *map, double place)
{
    size_t last = cm_colormap_stop_count(map) - 1;
    double before[2], behind[2];
    cm_colormap_stop(map, 0, before);
    for (size_t i = 0; i <= last; i++)
    {
        cm_colormap_stop(map, i, behind);
        if (behind[0] > place)
        {
            double turn = behind[1] - before[1];
            turn += turn > 180.0 ? -360.0 : turn < -180.0 ? 360.0 : 0.0;
            return i == 0 ? behind[1]
                          : before[1] + turn * (place - before[0]) / (behind[0] - before[0]);
        }
        memcpy(before, behind, sizeof before);
    }
    return before[1];
}

/* Lightness tells how far along the path a colour is; chroma and hue must belong to it. */
static void check_lightness_path(const cm_colormap *map, const cm_colormap_color *color,
                                 double half_turn, int neutral_light_end, const char *text)
{
    double range = parameter(map, "lightness-range");
    double dark = 100.0 * (1.0 - range), light = 100.0 * range;
    double ends = 1.0 - parameter(map, "saturation-range");
    double vivid = 50.0 * parameter(map, "saturation") * parameter(map, "saturation-range");
    double place = (color->lch[0] - dark) / (light - dark);
    double chroma = place < 0.5 ? dark * ends * (1.0 - 2.0 * place) + vivid * 2.0 * place
                                : light * (neutral_light_end ? 0.0 : ends) * (2.0 * place - 1.0) +
                                      vivid * (2.0 - 2.0 * place);
    double rotations = parameter(map, "rotations");
    double hue = cm_colormap_stop_count(map) > 0
                     ? stop_hue(map, place)
                     : parameter(map, "hue") + half_turn +
                           (isnan(rotations) ? 0.0 : 360.0 * rotations * place);
    double tolerance = 1e-9 / (2.0 * range - 1.0); /* place is that much less certain */
    REQUIRE(fabs(color->lch[1] - chroma) < 250.0 * tolerance, "%s: chroma %.17g, not %.17g", text,
            color->lch[1], chroma);
    REQUIRE(hue_difference(color->lch[2], hue) < 3600.0 * tolerance, "%s: hue %.17g, not %.17g",
            text, color->lch[2], hue);
}

static void check_path_at(const cm_colormap *map, double t, const char *text)
{
    const char *identifier = cm_colormap_describe(map)->identifier;
    cm_colormap_color color = color_at(map, t);
    double divergence = parameter(map, "divergence");
    double hue = parameter(map, "hue");
    double wanted = parameter(map, "saturation") * parameter(map, "lightness");
    if (strcmp(identifier, "diverging-lightness") == 0)
    {
        check_lightness_path(map, &color, t > 0.5 ? divergence : 0.0, 1, text);
        return;
    }
    if (isnan(parameter(map, "lightness")))
    {
        check_lightness_path(map, &color, 0.0, 0, text);
        return;
    }
    REQUIRE(color.lch[0] == parameter(map, "lightness"), "%s: lightness %.17g", text, color.lch[0]);
    if (strcmp(identifier, "sequential-saturation") == 0)
    {
        double range = parameter(map, "saturation-range");
        wanted = (1.0 - t) * (1.0 - range) * color.lch[0] + t * range * wanted;
    }
    else if (strcmp(identifier, "diverging-saturation") == 0)
    {
        wanted *= fabs(2.0 * t - 1.0);
        hue += t > 0.5 ? divergence : 0.0;
    }
    else
    {
        hue += t * divergence;
    }
    REQUIRE(fabs(color.lch[1] - wanted) < 1e-10, "%s: chroma %.17g, not %.17g", text, color.lch[1],
            wanted);
    REQUIRE(hue_difference(color.lch[2], hue) < 1e-10, "%s: hue %.17g, not %.17g", text,
            color.lch[2], hue);
}

static void check_path(const cm_colormap *map, const char *text)
{
    for (int i = 0; i <= 200 && !is_uniform(map); i++)
    {
        check_path_at(map, i / 200.0, text);
    }
}

START_TEST(paths_are_those_of_the_paper)
{
    state = 4;
    for_many_maps(40, make, check_path);
}
END_TEST

static void expect_lch(const cm_colormap *map, double t, double lightness, double chroma,
                       double hue)
{
    cm_colormap_color color = color_at(map, t);
    REQUIRE(color.lch[0] == lightness && color.lch[1] == chroma && color.lch[2] == hue,
            "t = %g: %.17g %.17g %.17g", t, color.lch[0], color.lch[1], color.lch[2]);
}

START_TEST(ends_are_exact)
{
    cm_colormap *map =
        make("single:hue=123,lightness-range=0.75,saturation-range=0.625,saturation=1");
    expect_lch(map, 0.0, 25.0, 25.0 * 0.375, 123.0);
    expect_lch(map, 1.0, 75.0, 75.0 * 0.375, 123.0);
    expect_lch(map, -1e-9, 25.0, 25.0 * 0.375, 123.0);
    expect_lch(map, 1.0 + 1e-9, 75.0, 75.0 * 0.375, 123.0);
    cm_colormap_destroy(map);
    map = make("rainbow:hue=90,rotations=1.5,lightness-range=0.75,saturation-range=1");
    expect_lch(map, 0.0, 25.0, 0.0, 90.0);
    expect_lch(map, 1.0, 75.0, 0.0, 270.0);
    cm_colormap_destroy(map);
    map = make("custom:hues=90@0.25/80@0.75,lightness-range=1,saturation-range=1");
    expect_lch(map, 0.0, 0.0, 0.0, 90.0);
    expect_lch(map, 1.0, 100.0, 0.0, 80.0);
    cm_colormap_destroy(map);
    map = make("saturation:hue=360,lightness=50,saturation-range=0.75,saturation=1");
    expect_lch(map, 0.0, 50.0, 12.5, 0.0);
    expect_lch(map, 1.0, 50.0, 37.5, 0.0);
    cm_colormap_destroy(map);
    map = make("diverging:hue=300,divergence=90,lightness-range=0.75,saturation-range=0.75");
    expect_lch(map, 0.0, 25.0, 6.25, 300.0);
    expect_lch(map, 0.5, 75.0, 0.0, 300.0);
    expect_lch(map, 1.0, 25.0, 6.25, 30.0);
    cm_colormap_destroy(map);
    map = make("diverging-saturation:hue=10,divergence=90,lightness=60,saturation=1");
    expect_lch(map, 0.0, 60.0, 60.0, 10.0);
    expect_lch(map, 0.5, 60.0, 0.0, 10.0);
    expect_lch(map, 1.0, 60.0, 60.0, 100.0);
    cm_colormap_destroy(map);
    map = make("qualitative:hue=10,divergence=90,lightness=60,saturation=0.5");
    expect_lch(map, 0.0, 60.0, 30.0, 10.0);
    expect_lch(map, 1.0, 60.0, 30.0, 100.0);
    cm_colormap_destroy(map);
}
END_TEST

static void check_order(const cm_colormap *map, const char *text)
{
    if ((isnan(parameter(map, "lightness-range")) && !is_uniform(map)) ||
        cm_colormap_describe(map)->family != CM_COLORMAP_SEQUENTIAL)
    {
        return;
    }
    double before = -1.0;
    for (int i = 0; i <= 1000; i++)
    {
        double lightness = color_at(map, i / 1000.0).lch[0];
        REQUIRE(lightness > before, "%s: %.17g after %.17g", text, lightness, before);
        before = lightness;
    }
}

START_TEST(lightness_grows)
{
    state = 5;
    for_many_maps(40, make, check_order);
}
END_TEST

/* Both halves are of the same length, and mirror images but for their hues. */
static void check_halves(const cm_colormap *map, const char *text)
{
    if (cm_colormap_describe(map)->family != CM_COLORMAP_DIVERGING || is_uniform(map))
    {
        return;
    }
    for (int i = 0; i <= 256; i++)
    {
        cm_colormap_color a = color_at(map, i / 512.0), b = color_at(map, 1.0 - i / 512.0);
        REQUIRE(fabs(a.lch[0] - b.lch[0]) < 1e-11 && fabs(a.lch[1] - b.lch[1]) < 1e-11,
                "%s: at %d / 512 %.17g %.17g and %.17g %.17g", text, i, a.lch[0], a.lch[1],
                b.lch[0], b.lch[1]);
    }
    cm_colormap_color middle = color_at(map, 0.5);
    ck_assert(middle.lch[1] == 0.0 && middle.luv[1] == 0.0 && middle.luv[2] == 0.0);
}

START_TEST(halves_are_alike)
{
    state = 6;
    for_many_maps(50, make, check_halves);
}
END_TEST

static void expect_hue(const char *hues, double t, double expected)
{
    char text[100];
    snprintf(text, sizeof text, "custom:hues=%s,lightness-range=0.8,saturation=0", hues);
    cm_colormap *map = make(text);
    /* without saturation, and with so pale ends, t is nearly the place */
    double hue = color_at(map, t).lch[2];
    REQUIRE(hue_difference(hue, expected) < 1.0, "%s: %g is %g", hues, t, hue);
    cm_colormap_destroy(map);
}

START_TEST(the_shorter_way_round)
{
    expect_hue("350/10", 0.5, 0.0);
    expect_hue("10/350", 0.5, 0.0);
    expect_hue("0/200", 0.5, 280.0);
    expect_hue("0/160", 0.5, 80.0);
    expect_hue("0/180", 0.5, 90.0); /* equally long: it grows */
    expect_hue("180/0", 0.5, 270.0);
    expect_hue("270/90", 0.5, 0.0);
    expect_hue("360/0", 0.5, 0.0);
    expect_hue("300@0.4/20@0.6", 0.1, 300.0); /* it stays before the first and after the last */
    expect_hue("300@0.4/20@0.6", 0.9, 20.0);
    expect_hue("300@0.4/20@0.6", 0.5, 340.0);
    expect_hue("77", 0.3, 77.0);
}
END_TEST

/* A hue of next to nothing below 0 is 0, not 360. */
START_TEST(hues_are_below_360)
{
    double lch[3];
    cm_colormap *map = make("rainbow:hue=0,rotations=-1");
    ck_assert_double_eq(color_at(map, 1e-20).lch[2], 0.0);
    cm_colormap_destroy(map);
    cm_colormap_lch_from_luv((const double[3]){50.0, 1.0, -1e-20}, lch);
    ck_assert_double_eq(lch[2], 0.0);
}
END_TEST

/* Corners are where they should be, and nowhere else. */
START_TEST(corners)
{
    static const struct
    {
        const char *specification;
        size_t count;
    } maps[] = {{"single:saturation-range=1", 1},
                {"rainbow", 1},
                {"custom:hues=90", 1},
                {"custom:hues=10@0/20@0.25/30@0.5/100@0.75/120@1", 2}, /* 20 is on the way to 30 */
                {"saturation", 0},
                {"diverging", 3},
                {"diverging-saturation", 1},
                {"diverging-saturation:divergence=180", 0},
                {"qualitative", 0},
                {"qualitative:lightness=0", 0},
                {"uniform-purple-yellow", 0},
                {"uniform-blue-red", 1},
                {"uniform-cyclic", 0}};
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++)
    {
        cm_colormap *map = make(maps[i].specification);
        REQUIRE(cm_colormap_corner_count(map) == maps[i].count, "%s has %zu", maps[i].specification,
                cm_colormap_corner_count(map));
        double before = 0.0;
        for (size_t k = 0; k < maps[i].count; k++)
        {
            ck_assert_double_gt(cm_colormap_corner(map, k), before);
            before = cm_colormap_corner(map, k);
        }
        ck_assert_double_lt(before, 1.0);
        ck_assert_double_nan(cm_colormap_corner(map, maps[i].count));
        cm_colormap_destroy(map);
    }
}
END_TEST

/* ---------------------------------------------------------------- samples */

START_TEST(no_places)
{
    const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, -1e-8, 1.0 + 1e-8, 2.0};
    for (size_t i = 0; i < cm_colormap_count(); i++)
    {
        cm_colormap *map = make(cm_colormap_at(i)->identifier);
        for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++)
        {
            cm_colormap_color color = color_at(map, bad[k]);
            ck_assert(all_nan(color.lch) && all_nan(color.luv) && all_nan(color.linear) &&
                      all_nan(color.srgb) && !color.inside);
        }
        ck_assert_double_nan(cm_colormap_position(map, 0, 0));
        ck_assert_double_nan(cm_colormap_position(map, 5, 5));
        cm_colormap_destroy(map);
    }
}
END_TEST

/* Against single colours, and nothing beyond the array is touched. */
static void check_samples_of(const cm_colormap *map, size_t n, const char *text)
{
    double *srgb = malloc((3 * n + 1) * sizeof *srgb);
    uint8_t *bytes = malloc(3 * n + 1);
    cm_colormap_clipping found, of_bytes;
    size_t outside = 0, first = 0;
    ck_assert(srgb != NULL && bytes != NULL);
    srgb[3 * n] = 7.0;
    bytes[3 * n] = 77;
    cm_colormap_samples(map, n, srgb, &found);
    cm_colormap_samples_u8(map, n, bytes, &of_bytes);
    ck_assert(srgb[3 * n] == 7.0 && bytes[3 * n] == 77);
    for (size_t i = 0; i < n; i++)
    {
        double t = cm_colormap_position(map, n, i);
        cm_colormap_color color = color_at(map, t);
        int inside = 1;
        for (size_t k = 0; k < 3; k++)
        {
            double cut = fmin(fmax(color.srgb[k], 0.0), 1.0);
            inside = inside && color.linear[k] >= -1e-9 && color.linear[k] <= 1.0 + 1e-9;
            REQUIRE(srgb[3 * i + k] == cut, "%s: %zu", text, i);
            REQUIRE(fabs(bytes[3 * i + k] - cut * 255.0) <= 0.5 + 1e-12, "%s: %zu", text, i);
        }
        ck_assert_int_eq(color.inside != 0, inside);
        first = !inside && outside == 0 ? i : first;
        outside += !inside;
    }
    REQUIRE(found.count == outside && found.first == first, "%s: %zu clipped, the first %zu", text,
            found.count, found.first);
    ck_assert(outside == 0 ? isnan(found.first_t)
                           : found.first_t == cm_colormap_position(map, n, first));
    ck_assert((found.excess > 1e-9) == (outside > 0));
    ck_assert(found.count == of_bytes.count && found.excess == of_bytes.excess);
    free(srgb);
    free(bytes);
}

static void check_samples(const cm_colormap *map, const char *text)
{
    static const size_t sizes[] = {0, 1, 2, 3, 256, 257};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
    {
        check_samples_of(map, sizes[i], text);
    }
    cm_colormap_clipping found = {1, 1, 1.0, 1.0};
    cm_colormap_samples(map, 0, NULL, &found);
    ck_assert(found.count == 0 && isnan(found.first_t));
    cm_colormap_samples(map, 0, NULL, NULL);
    cm_colormap_samples_u8(map, 0, NULL, NULL);
}

START_TEST(samples)
{
    state = 7;
    for_many_maps(8, make, check_samples);
    cm_colormap *map = make("rainbow:saturation=3");
    check_samples_of(map, 100000, "rainbow");
    cm_colormap_destroy(map);
}
END_TEST

/* Between all neighbours, the last and the first included, is at least a step, and all steps are the
 * same. */
START_TEST(classes_are_apart)
{
    static const double ranges[] = {0.0, 90.0, 300.0, 330.0, 359.0, 360.0};
    for (size_t k = 0; k < sizeof ranges / sizeof ranges[0]; k++)
    {
        char text[100];
        snprintf(text, sizeof text, "qualitative:hue=20,divergence=%g", ranges[k]);
        cm_colormap *map = make(text);
        for (size_t n = 2; n <= 40; n++)
        {
            double step = fmin(ranges[k] / (double)(n - 1), 360.0 / (double)n);
            for (size_t i = 0; i < n; i++)
            {
                double hue = color_at(map, cm_colormap_position(map, n, i)).lch[2];
                REQUIRE(hue_difference(hue, 20.0 + step * (double)i) < 1e-9, "%s: %zu of %zu is %g",
                        text, i, n, hue);
            }
        }
        cm_colormap_destroy(map);
    }
}
END_TEST

/* ---------------------------------------------------------------- the gamut */

START_TEST(largest_chroma)
{
    for (int i = 0; i < 100 * 72; i++)
    {
        double lightness = 0.5 + i / 72, hue = 5.0 * (i % 72) + 0.3;
        double most = cm_colormap_largest_chroma(lightness, hue);
        for (int side = 0; side < 2; side++)
        {
            const double lch[3] = {lightness, most * (side == 0 ? 1.0 - 1e-9 : 1.0 + 1e-6), hue};
            double luv[3], linear[3];
            cm_colormap_luv_from_lch(lch, luv);
            cm_colormap_linear_from_luv(luv, linear);
            int inside = fmin(linear[0], fmin(linear[1], linear[2])) >= 0.0 &&
                         fmax(linear[0], fmax(linear[1], linear[2])) <= 1.0;
            REQUIRE(inside == (side == 0), "L %g, H %g: %.17g", lightness, hue, most);
        }
    }
    ck_assert_double_eq(cm_colormap_largest_chroma(0.0, 77.0), 0.0);
    ck_assert_double_eq(cm_colormap_largest_chroma(100.0, 77.0), 0.0);
    ck_assert_double_nan(cm_colormap_largest_chroma(-1.0, 0.0));
    ck_assert_double_nan(cm_colormap_largest_chroma(100.1, 0.0));
    ck_assert_double_nan(cm_colormap_largest_chroma((double)NAN, 0.0));
    ck_assert_double_nan(cm_colormap_largest_chroma(50.0, (double)INFINITY));
    ck_assert_double_eq_tol(cm_colormap_largest_chroma(53.237115595429, 12.1770506300617),
                            179.0380969, 1e-6); /* red: hypot(175.0098..., 37.7650...) */
}
END_TEST

static size_t clipped_of(const cm_colormap *map, size_t n)
{
    double *srgb = malloc(3 * n * sizeof *srgb);
    cm_colormap_clipping found;
    ck_assert_ptr_nonnull(srgb);
    cm_colormap_samples(map, n, srgb, &found);
    free(srgb);
    return found.count;
}

/* The map with another saturation. */
static cm_colormap *with_saturation(const cm_colormap *map, double saturation)
{
    char text[1024];
    cm_colormap_specification(map, text, sizeof text);
    snprintf(strstr(text, "saturation=") + strlen("saturation="), 40, "%.17g", saturation);
    return make(text);
}

static int fitted_count;

/* The saturation is the last parameter of each model but one, where rotations follow. */
static void check_fit(const cm_colormap *map, const char *text)
{
    cm_colormap *fitted = NULL;
    ck_assert_int_eq(cm_colormap_fit(map, &fitted), CM_OK);
    REQUIRE(cm_colormap_inside(fitted), "%s: fitted, but not inside", text);
    REQUIRE(clipped_of(fitted, 3001) == 0, "%s: fitted, but clipped", text);
    if (is_uniform(map))
    {
        check_specification(fitted, text);
        cm_colormap_destroy(fitted);
        return;
    }
    double before = parameter(map, "saturation"), behind = parameter(fitted, "saturation");
    ck_assert_double_le(behind, before);
    if (cm_colormap_inside(map))
    {
        ck_assert_double_eq(behind, before);
        ck_assert_uint_eq(clipped_of(map, 3001), 0);
    }
    else if (!isnan(cm_colormap_largest_saturation(map)))
    {
        ck_assert_double_eq(cm_colormap_largest_saturation(map), behind);
    }
    if (behind < before && isnan(parameter(map, "rotations")))
    {
        cm_colormap *more = with_saturation(fitted, fmin(behind * 1.0001 + 1e-6, 5.0));
        REQUIRE(!cm_colormap_inside(more), "%s: %.17g is not the largest", text, behind);
        cm_colormap_destroy(more);
        fitted_count++;
    }
    cm_colormap_destroy(fitted);
}

START_TEST(fit)
{
    state = 8;
    fitted_count = 0;
    for_many_maps(100, make, check_fit);
    ck_assert_int_gt(fitted_count, 200);
}
END_TEST

/* Where the worst place is known, samples there are clipped with a bit more. */
START_TEST(a_bit_more_is_clipped)
{
    cm_colormap *map = make_fitted("saturation:saturation=5");
    double fits = parameter(map, "saturation");
    ck_assert_uint_eq(clipped_of(map, 101), 0);
    cm_colormap *more = with_saturation(map, fits * (1.0 + 1e-6));
    ck_assert_uint_eq(clipped_of(more, 101), 1); /* the last one */
    cm_colormap_destroy(more);
    cm_colormap_destroy(map);
}
END_TEST

START_TEST(fit_of_pale_ends)
{
    cm_colormap *map = make("single:lightness-range=1,saturation-range=0.75,saturation=2");
    cm_colormap *fitted = NULL;
    ck_assert_int_eq(cm_colormap_inside(map), 0);
    ck_assert_double_nan(cm_colormap_largest_saturation(map));
    ck_assert_int_eq(cm_colormap_fit(map, &fitted), CM_OK);
    ck_assert_double_eq(parameter(fitted, "saturation-range"), 1.0); /* white has no chroma */
    ck_assert_double_gt(parameter(fitted, "saturation"), 1.5);
    cm_colormap_destroy(map);
    cm_colormap_destroy(fitted);
    map = make("qualitative:lightness=0");
    ck_assert_double_eq(cm_colormap_length(map), 0.0);
    ck_assert(cm_colormap_inside(map));
    cm_colormap_destroy(map);
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
    const TTest *tests[] = {catalogue,
                            standard_maps,
                            wrong_specifications,
                            wrong_stops,
                            missing_arguments,
                            numbers,
                            stops,
                            specifications_come_back,
                            a_point_in_every_locale,
                            known_colors,
                            red_of_other_programs,
                            printed_matrix,
                            conversions_come_back,
                            transfer_function_has_an_inverse,
                            no_colors,
                            standard_maps_have_constant_speed,
                            the_speed_is_constant_to_nine_digits,
                            other_maps_have_constant_speed,
                            maps_out_of_gamut_have_constant_speed,
                            samples_of_standard_maps_are_even,
                            samples_are_even_with_every_number,
                            samples_of_other_maps_are_even,
                            places_of_few_samples,
                            samples_of_many_stops,
                            places_without_corners,
                            places_of_enormous_numbers,
                            paths_are_those_of_the_paper,
                            ends_are_exact,
                            lightness_grows,
                            halves_are_alike,
                            the_shorter_way_round,
                            hues_are_below_360,
                            corners,
                            no_places,
                            samples,
                            classes_are_apart,
                            largest_chroma,
                            fit,
                            a_bit_more_is_clipped,
                            fit_of_pale_ends,
#ifdef WRAPS_MALLOC
                            without_memory,
#endif
                            NULL};
    return run_suite("colormap", tests);
}
