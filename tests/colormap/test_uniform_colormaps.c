/* SPDX-License-Identifier: MIT
 *
 * CAM16, CAM16-UCS and CIEDE2000 against what has been published, and the uniform maps against what they promise.
 */
#include <cubemap/colormap.h>

#include "own_colors.h"
#include "tests/suite.h"

static const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};

static int all_nan(const double values[3])
{
    return isnan(values[0]) && isnan(values[1]) && isnan(values[2]);
}

/* ---------------------------------------------------------------- CIEDE2000 */

/* Sharma et al. 2005, table 1, of which the last digit is the fourth. */
static const struct
{
    double one[3];
    double other[3];
    double difference;
} sharma[] = {
    {{50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}, 2.0425},
    {{50.0, 3.1571, -77.2803}, {50.0, 0.0, -82.7485}, 2.8615},
    {{50.0, 2.8361, -74.02}, {50.0, 0.0, -82.7485}, 3.4412},
    {{50.0, -1.3802, -84.2814}, {50.0, 0.0, -82.7485}, 1.0},
    {{50.0, -1.1848, -84.8006}, {50.0, 0.0, -82.7485}, 1.0},
    {{50.0, -0.9009, -85.5211}, {50.0, 0.0, -82.7485}, 1.0},
    {{50.0, 0.0, 0.0}, {50.0, -1.0, 2.0}, 2.3669},
    {{50.0, -1.0, 2.0}, {50.0, 0.0, 0.0}, 2.3669},
    {{50.0, 2.49, -0.001}, {50.0, -2.49, 0.0009}, 7.1792},
    {{50.0, 2.49, -0.001}, {50.0, -2.49, 0.001}, 7.1792},
    {{50.0, 2.49, -0.001}, {50.0, -2.49, 0.0011}, 7.2195},
    {{50.0, 2.49, -0.001}, {50.0, -2.49, 0.0012}, 7.2195},
    {{50.0, -0.001, 2.49}, {50.0, 0.0009, -2.49}, 4.8045},
    {{50.0, -0.001, 2.49}, {50.0, 0.001, -2.49}, 4.8045},
    {{50.0, -0.001, 2.49}, {50.0, 0.0011, -2.49}, 4.7461},
    {{50.0, 2.5, 0.0}, {50.0, 0.0, -2.5}, 4.3065},
    {{50.0, 2.5, 0.0}, {73.0, 25.0, -18.0}, 27.1492},
    {{50.0, 2.5, 0.0}, {61.0, -5.0, 29.0}, 22.8977},
    {{50.0, 2.5, 0.0}, {56.0, -27.0, -3.0}, 31.903},
    {{50.0, 2.5, 0.0}, {58.0, 24.0, 15.0}, 19.4535},
    {{50.0, 2.5, 0.0}, {50.0, 3.1736, 0.5854}, 1.0},
    {{50.0, 2.5, 0.0}, {50.0, 3.2972, 0.0}, 1.0},
    {{50.0, 2.5, 0.0}, {50.0, 1.8634, 0.5757}, 1.0},
    {{50.0, 2.5, 0.0}, {50.0, 3.2592, 0.335}, 1.0},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.263},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.248, -4.962}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.694}, {23.0331, 14.973, -42.5619}, 2.0373},
    {{36.4612, 47.858, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.441}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.135}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

START_TEST(published_differences)
{
    const size_t count = sizeof sharma / sizeof sharma[0];
    ck_assert_uint_eq(count, 34);
    for (size_t i = 0; i < count; i++)
    {
        double there = cm_colormap_ciede2000(sharma[i].one, sharma[i].other);
        double back = cm_colormap_ciede2000(sharma[i].other, sharma[i].one);
        REQUIRE(fabs(there - sharma[i].difference) < 0.5001e-4, "pair %zu: %.17g, not %g", i + 1,
                there, sharma[i].difference);
        /* of opposite hues as well */
        REQUIRE(fabs(there - back) < 1e-12, "pair %zu: %.17g back", i + 1, back);
    }
}
END_TEST

static double uniform(uint64_t *state, double low, double high)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*state >> 11) * 0x1p-53;
}

START_TEST(differences_as_printed)
{
    uint64_t state = 1;
    for (int i = 0; i < 100000; i++)
    {
        double one[3], other[3];
        const double reach = i % 2 == 0 ? 3.0 : 100.0;
        for (int k = 0; k < 3; k++)
        {
            one[k] = k == 0 ? uniform(&state, 0.0, 100.0) : uniform(&state, -120.0, 120.0);
            other[k] = one[k] + uniform(&state, -reach, reach);
        }
        double difference = cm_colormap_ciede2000(one, other);
        double own = own_ciede2000(one, other);
        REQUIRE(fabs(difference - own) < 1e-9 && difference > 0.0,
                "%.17g %.17g %.17g, %.17g %.17g %.17g: %.17g, not %.17g", one[0], one[1], one[2],
                other[0], other[1], other[2], difference, own);
    }
}
END_TEST

START_TEST(differences_of_greys)
{
    const double black[3] = {0.0, 0.0, 0.0}, middle[3] = {50.0, 0.0, 0.0},
                 red[3] = {50.0, 9.0, 0.0};
    const double vivid[3] = {50.0, 1e60, 0.0}, green[3] = {50.0, 0.0, 9.0};
    ck_assert_double_eq(cm_colormap_ciede2000(middle, middle), 0.0);
    ck_assert_double_eq(cm_colormap_ciede2000(red, red), 0.0);
    ck_assert_double_eq_tol(cm_colormap_ciede2000(black, middle), own_ciede2000(black, middle),
                            1e-12);
    ck_assert_double_eq_tol(cm_colormap_ciede2000(middle, green), own_ciede2000(middle, green),
                            1e-12);
    ck_assert_double_eq_tol(cm_colormap_ciede2000(green, middle), own_ciede2000(green, middle),
                            1e-12);
    ck_assert(isfinite(cm_colormap_ciede2000(middle, vivid)));
    for (int i = 0; i < 9; i++)
    {
        double one[3] = {50.0, 1.0, 1.0};
        one[i % 3] = bad[i / 3];
        ck_assert_double_nan(cm_colormap_ciede2000(one, red));
        ck_assert_double_nan(cm_colormap_ciede2000(red, one));
    }
}
END_TEST

/* ---------------------------------------------------------------- CAM16 */

/* Computed by the authors' program; printed in the documentation of colour-science, function XYZ_to_CAM16. */
static const struct
{
    double xyz[3];
    cm_colormap_viewing viewing;
    cm_colormap_appearance appearance;
} published[] = {
    {{19.01, 20.00, 21.78},
     {{95.05, 100.0, 108.88}, 318.31, 20.0},
     {41.73120791, 0.10335574, 217.06795977, 0.10743677}},
    {{57.06, 43.06, 31.96},
     {{95.05, 100.0, 108.88}, 31.83, 20.0},
     {65.42828069, 49.67956420, 17.48659243, 42.62473321}},
    {{3.53, 6.56, 2.14},
     {{109.85, 100.0, 35.58}, 318.31, 20.0},
     {21.36052893, 50.99381895, 178.86724266, 53.00732582}},
};

START_TEST(published_appearances)
{
    for (size_t i = 0; i < sizeof published / sizeof published[0]; i++)
    {
        const cm_colormap_appearance *wanted = &published[i].appearance;
        cm_colormap_appearance got;
        cm_colormap_cam16(published[i].xyz, &published[i].viewing, &got);
        REQUIRE(fabs(got.lightness - wanted->lightness) < 1e-8 &&
                    fabs(got.chroma - wanted->chroma) < 1e-8 &&
                    fabs(got.hue - wanted->hue) < 1e-8 &&
                    fabs(got.colorfulness - wanted->colorfulness) < 1e-8,
                "%zu: %.17g %.17g %.17g %.17g", i, got.lightness, got.chroma, got.hue,
                got.colorfulness);
    }
}
END_TEST

static int is_no_appearance(const cm_colormap_appearance *seen)
{
    return isnan(seen->lightness) && isnan(seen->chroma) && isnan(seen->hue) &&
           isnan(seen->colorfulness);
}

START_TEST(no_appearances)
{
    const double xyz[3] = {19.01, 20.0, 21.78};
    cm_colormap_appearance seen;
    for (int i = 0; i < 9; i++)
    {
        double wrong[3] = {19.01, 20.0, 21.78};
        wrong[i % 3] = bad[i / 3];
        cm_colormap_cam16(wrong, NULL, &seen);
        REQUIRE(is_no_appearance(&seen), "%d", i);
    }
    for (int i = 0; i < 25; i++)
    {
        const double values[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 0.0, -1.0};
        cm_colormap_viewing viewing = published[0].viewing;
        double *const field[] = {&viewing.white[0], &viewing.white[1], &viewing.white[2],
                                 &viewing.luminance, &viewing.background};
        *field[i % 5] = values[i / 5];
        cm_colormap_cam16(xyz, &viewing, &seen);
        REQUIRE(is_no_appearance(&seen), "viewing %d", i);
    }
    cm_colormap_cam16((const double[3]){-10.0, -10.0, -10.0}, NULL, &seen);
    ck_assert(is_no_appearance(&seen));
    cm_colormap_cam16((const double[3]){0.0, 0.0, 0.0}, NULL, &seen);
    ck_assert(seen.lightness == 0.0 && seen.chroma == 0.0 && seen.colorfulness == 0.0);
}
END_TEST

/* The hue is in [0, 360), in all quadrants, and the conditions of sRGB are those that NULL stands for. */
START_TEST(appearances_of_srgb)
{
    const cm_colormap_viewing viewing = {
        {100.0 * 0.3127 / 0.3290, 100.0, 100.0 * 0.3583 / 0.3290}, 64.0 / PI / 5.0, 20.0};
    for (int i = 0; i < 1000; i++)
    {
        const double linear[3] = {i % 10 / 9.0, i / 10 % 10 / 9.0, i / 100 / 9.0};
        double matrix[3][3], xyz[3], ucs[3];
        cm_colormap_appearance seen, same;
        derive_matrix(matrix);
        for (int k = 0; k < 3; k++)
        {
            xyz[k] = 100.0 * (matrix[k][0] * linear[0] + matrix[k][1] * linear[1] +
                              matrix[k][2] * linear[2]);
        }
        cm_colormap_cam16(xyz, NULL, &seen);
        cm_colormap_cam16(xyz, &viewing, &same);
        cm_colormap_ucs_from_linear(linear, ucs);
        double chroma = log1p(0.0228 * seen.colorfulness) / 0.0228;
        REQUIRE(fabs(seen.lightness - same.lightness) < 1e-10 && fabs(seen.hue - same.hue) < 1e-8 &&
                    seen.hue >= 0.0 && seen.hue < 360.0,
                "%d: hue %.17g", i, seen.hue);
        REQUIRE(fabs(1.7 * seen.lightness / (1.0 + 0.007 * seen.lightness) - ucs[0]) < 1e-9 &&
                    fabs(chroma - hypot(ucs[1], ucs[2])) < 1e-9,
                "%d: %.17g %.17g", i, ucs[0], chroma);
    }
}
END_TEST

/* Where b goes through 0 from below, next to nothing below 0 is hue 0, not 360. */
START_TEST(hues_are_below_360)
{
    double xyz[3] = {40.0, 30.0, 0.0}, low = 20.0, high = 40.0;
    int below = 0, zero = 0;
    cm_colormap_appearance seen;
    for (int i = 0; i < 100; i++)
    {
        xyz[2] = 0.5 * (low + high);
        cm_colormap_cam16(xyz, NULL, &seen);
        *(seen.hue > 180.0 ? &high : &low) = xyz[2];
    }
    for (int i = 0; i < 400; i++)
    {
        xyz[2] = low + (i - 200) * 4e-15;
        cm_colormap_cam16(xyz, NULL, &seen);
        REQUIRE(seen.hue < 1e-9 || (seen.hue > 359.0 && seen.hue < 360.0), "%.17g", seen.hue);
        below += seen.hue > 359.0;
        zero += seen.hue == 0.0;
    }
    ck_assert_int_gt(below, 20);
    ck_assert_int_gt(zero, 0);
}
END_TEST

/* ---------------------------------------------------------------- conversions */

START_TEST(conversions_come_back)
{
    double worst = 0.0;
    for (int i = 0; i < 33 * 33 * 33; i++)
    {
        const double srgb[3] = {i % 33 / 32.0, i / 33 % 33 / 32.0, i / 1089 / 32.0};
        double linear[3], ucs[3], own[3], lab[3], own_of_lab[3], again[3];
        cm_colormap_linear_from_srgb(srgb, linear);
        cm_colormap_ucs_from_linear(linear, ucs);
        cm_colormap_lab_from_linear(linear, lab);
        own_ucs(srgb, own);
        own_lab(srgb, own_of_lab);
        cm_colormap_linear_from_ucs(ucs, again);
        worst = fmax(worst, distance(linear, again));
        REQUIRE(distance(linear, again) < 1e-12, "%g %g %g: %g", srgb[0], srgb[1], srgb[2],
                distance(linear, again));
        REQUIRE(distance(ucs, own) < 1e-9 && distance(lab, own_of_lab) < 1e-10,
                "%g %g %g: %g in CAM16-UCS, %g in CIELAB", srgb[0], srgb[1], srgb[2],
                distance(ucs, own), distance(lab, own_of_lab));
    }
    printf("CAM16-UCS and back: within %.2g\n", worst);
}
END_TEST

/* White has J' = 100 and is, like grey, not quite at a' = b' = 0. */
START_TEST(known_places)
{
    double ucs[3];
    cm_colormap_ucs_from_linear((const double[3]){1.0, 1.0, 1.0}, ucs);
    ck_assert_double_eq_tol(ucs[0], 100.0, 1e-12);
    ck_assert_double_eq_tol(ucs[1], -1.89825081, 1e-8);
    ck_assert_double_eq_tol(ucs[2], -1.07543703, 1e-8);
    cm_colormap_ucs_from_linear((const double[3]){0.0, 0.0, 0.0}, ucs);
    ck_assert(ucs[0] == 0.0 && ucs[1] == 0.0 && ucs[2] == 0.0);
    for (int i = 0; i <= 100; i++)
    {
        const double grey[3] = {i / 100.0, i / 100.0, i / 100.0};
        cm_colormap_ucs_from_linear(grey, ucs);
        ck_assert_double_lt(hypot(ucs[1], ucs[2]), 2.2);
    }
}
END_TEST

START_TEST(no_colors)
{
    static const double none[][3] = {{-1.0, 0.0, 0.0},
                                     {243.0, 0.0, 0.0},
                                     {50.0, -1e3, 0.0},
                                     {50.0, 0.0, -1e3},
                                     {50.0, 1e300, 1e300}};
    double result[3];
    for (int i = 0; i < 9; i++)
    {
        double values[3] = {50.0, 1.0, 1.0};
        values[i % 3] = bad[i / 3];
        cm_colormap_linear_from_ucs(values, result);
        REQUIRE(all_nan(result), "linear_from_ucs %d", i);
        cm_colormap_ucs_from_linear(values, result);
        REQUIRE(all_nan(result), "ucs_from_linear %d", i);
        cm_colormap_lab_from_linear(values, result);
        REQUIRE(all_nan(result), "lab_from_linear %d", i);
    }
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
    {
        cm_colormap_linear_from_ucs(none[i], result);
        REQUIRE(all_nan(result), "%zu: %g %g %g", i, result[0], result[1], result[2]);
    }
    cm_colormap_ucs_from_linear((const double[3]){-1.0, -1.0, -1.0}, result);
    ck_assert(all_nan(result));
    cm_colormap_linear_from_ucs((const double[3]){0.0, 5.0, 7.0}, result);
    ck_assert(result[0] == 0.0 && result[1] == 0.0 && result[2] == 0.0);
}
END_TEST

/* ---------------------------------------------------------------- the maps */

enum
{
    SAMPLES_MAX = 257
};

/* The standard deviation of steps, as a part of their mean. */
static double unevenness(const double *step, size_t count)
{
    double mean = 0.0, sum = 0.0;
    for (size_t i = 0; i < count; i++)
    {
        mean += step[i] / (double)count;
    }
    for (size_t i = 0; i < count; i++)
    {
        sum += (step[i] - mean) * (step[i] - mean) / (double)count;
    }
    return sqrt(sum) / mean;
}

/* Of as many colours as the program writes. */
static void measure(const cm_colormap_info *info, double *in_ucs, double *by_ciede2000)
{
    const size_t n = info->family == CM_COLORMAP_DIVERGING ? 257 : 256;
    double srgb[3 * SAMPLES_MAX], ucs[2][3], lab[2][3], straight[SAMPLES_MAX], seen[SAMPLES_MAX];
    cm_colormap *map = NULL;
    cm_colormap_clipping clipping;
    ck_assert_int_eq(cm_colormap_create(info->identifier, &map), CM_OK);
    cm_colormap_samples(map, n, srgb, &clipping);
    ck_assert_uint_eq(clipping.count, 0);
    cm_colormap_destroy(map);
    for (size_t i = 0; i < n; i++)
    {
        own_ucs(srgb + 3 * i, ucs[i % 2]);
        own_lab(srgb + 3 * i, lab[i % 2]);
        if (i > 0)
        {
            straight[i - 1] = distance(ucs[0], ucs[1]);
            seen[i - 1] = own_ciede2000(lab[(i - 1) % 2], lab[i % 2]);
        }
    }
    *in_ucs = unevenness(straight, n - 1);
    *by_ciede2000 = unevenness(seen, n - 1);
}

/* Viridis has 14.9 %, and 5.8 % in CAM16-UCS: research/colormap/uniform-paths --measure viridis. */
START_TEST(uniform_maps_are_more_even_than_viridis)
{
    size_t count[4] = {0, 0, 0, 0};
    for (size_t i = 0; i < cm_colormap_count(); i++)
    {
        const cm_colormap_info *info = cm_colormap_at(i);
        if (info->space == CM_COLORMAP_CAM16_UCS)
        {
            double in_ucs, by_ciede2000;
            measure(info, &in_ucs, &by_ciede2000);
            printf("%s: %.2g %% in CAM16-UCS, %.3g %% by CIEDE2000\n", info->identifier,
                   100.0 * in_ucs, 100.0 * by_ciede2000);
            REQUIRE(in_ucs < 2e-4, "%s: %g in CAM16-UCS", info->identifier, in_ucs);
            REQUIRE(by_ciede2000 < 0.09, "%s: %g by CIEDE2000", info->identifier, by_ciede2000);
            count[info->family]++;
        }
    }
    ck_assert(count[CM_COLORMAP_SEQUENTIAL] >= 4 && count[CM_COLORMAP_DIVERGING] >= 2 &&
              count[CM_COLORMAP_CYCLIC] >= 1);
}
END_TEST

/* What the guide says of the others. */
START_TEST(other_maps_are_less_even_than_viridis)
{
    for (size_t i = 0; i < cm_colormap_count(); i++)
    {
        const cm_colormap_info *info = cm_colormap_at(i);
        double in_ucs, by_ciede2000;
        if (info->space == CM_COLORMAP_CIELUV)
        {
            measure(info, &in_ucs, &by_ciede2000);
            REQUIRE(by_ciede2000 > 0.18 && by_ciede2000 < 0.65, "%s: %g", info->identifier,
                    by_ciede2000);
        }
    }
}
END_TEST

static cm_colormap_color color_at(const char *identifier, double t)
{
    cm_colormap *map = NULL;
    cm_colormap_color color;
    ck_assert_int_eq(cm_colormap_create(identifier, &map), CM_OK);
    cm_colormap_color_at(map, t, &color);
    cm_colormap_destroy(map);
    return color;
}

START_TEST(a_cyclic_map_closes)
{
    cm_colormap *map = NULL;
    double before[3], here[3];
    ck_assert_int_eq(cm_colormap_create("uniform-cyclic", &map), CM_OK);
    cm_colormap_color start = color_at("uniform-cyclic", 0.0),
                      end = color_at("uniform-cyclic", 1.0);
    ck_assert_double_lt(distance(start.srgb, end.srgb), 1e-12);
    /* the step from the last sample to the first is like the others */
    double srgb[3 * 100], shortest = (double)INFINITY, longest = 0.0;
    cm_colormap_samples(map, 100, srgb, NULL);
    for (int i = 0; i < 100; i++)
    {
        own_ucs(srgb + 3 * i, before);
        own_ucs(srgb + 3 * ((i + 1) % 100), here);
        shortest = fmin(shortest, distance(before, here));
        longest = fmax(longest, distance(before, here));
    }
    REQUIRE(shortest > 0.99 * longest, "%g to %g", shortest, longest);
    cm_colormap_destroy(map);
}
END_TEST

/* Lightness of both halves is nearly that of the other; the middle is the lightest, and grey. */
START_TEST(diverging_halves)
{
    static const char *const names[] = {"uniform-blue-red", "uniform-purple-green"};
    for (int i = 0; i < 2; i++)
    {
        double middle[3], left[3], right[3];
        cm_colormap_color grey = color_at(names[i], 0.5);
        own_ucs(grey.srgb, middle);
        ck_assert_double_eq_tol(middle[0], 95.0, 1e-9);
        ck_assert_double_eq_tol(grey.srgb[0], grey.srgb[1], 1e-12);
        ck_assert_double_eq_tol(grey.srgb[0], grey.srgb[2], 1e-12);
        for (int k = 0; k < 50; k++)
        {
            own_ucs(color_at(names[i], k / 100.0).srgb, left);
            own_ucs(color_at(names[i], 1.0 - k / 100.0).srgb, right);
            REQUIRE(fabs(left[0] - right[0]) < 3.0 && left[0] < 95.0 && right[0] < 95.0,
                    "%s: J' %g and %g at %g", names[i], left[0], right[0], k / 100.0);
        }
    }
}
END_TEST

/* An even number of samples steps over the middle: that step, too, is as long as the others. */
START_TEST(even_numbers_of_samples)
{
    static const char *const names[] = {"uniform-blue-red", "uniform-purple-green"};
    enum
    {
        N = 64
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    {
        cm_colormap *map;
        double at[N][3], length[N - 1], mean = 0.0;
        ck_assert_int_eq(cm_colormap_create(names[i], &map), CM_OK);
        for (size_t k = 0; k < N; k++)
        {
            cm_colormap_color color;
            cm_colormap_color_at(map, cm_colormap_position(map, N, k), &color);
            cm_colormap_ucs_from_linear(color.linear, at[k]);
        }
        for (size_t k = 0; k + 1 < N; k++)
        {
            length[k] = hypot(at[k + 1][0] - at[k][0],
                              hypot(at[k + 1][1] - at[k][1], at[k + 1][2] - at[k][2]));
            mean += length[k] / (N - 1);
        }
        for (size_t k = 0; k + 1 < N; k++)
        {
            REQUIRE(fabs(length[k] / mean - 1.0) < 0.005, "%s: step %zu is %g of the mean",
                    names[i], k, length[k] / mean);
        }
        cm_colormap_destroy(map);
    }
}
END_TEST

int main(void)
{
    const TTest *tests[] = {published_differences,
                            differences_as_printed,
                            differences_of_greys,
                            published_appearances,
                            no_appearances,
                            appearances_of_srgb,
                            hues_are_below_360,
                            conversions_come_back,
                            known_places,
                            no_colors,
                            uniform_maps_are_more_even_than_viridis,
                            other_maps_are_less_even_than_viridis,
                            a_cyclic_map_closes,
                            diverging_halves,
                            even_numbers_of_samples,
                            NULL};
    return run_suite("uniform colormaps", tests);
}
