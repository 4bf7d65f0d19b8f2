/* SPDX-License-Identifier: MIT
 *
 * The quintic spline through seams, and values at directions.
 */
#include "tests/image/round_scene.h"

/* Pixels between an edge and what counts as near to it. */
#define NEAR 3.0

static const char *const surfaces[] = {
    "equirect;size=128",    "cube:coupled;size=48", "cube:gnomonic;size=48",     "cube:qsc;size=48",
    "cube:healpix;size=48", "cube:tangent;size=33", "equirect;size=97;height=51"};

START_TEST(the_spline_goes_through_all_pixels)
{
    for (size_t s = 0; s < sizeof surfaces / sizeof *surfaces; s++)
    {
        cm_surface *surface = make_surface(surfaces[s]);
        cm_image source[PICTURES_MOST], target[PICTURES_MOST];
        make_pictures(surface, CM_PIXEL_FLOAT, 2, source);
        make_pictures(surface, CM_PIXEL_FLOAT, 2, target);
        paint_noise(surface, source);
        cm_plan *plan = make_plan(surface, surface, CM_FILTER_BSPLINE5);
        ck_assert_int_eq(cm_resample(plan, source, target, (cm_rows){0}), CM_OK);
        for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
        {
            const float *a = source[i].data, *b = target[i].data;
            for (size_t k = 0; k < picture_bytes(&source[i]) / sizeof *a; k++)
            {
                ck_assert_msg(fabsf(a[k] - b[k]) < 4e-6f, "%s, picture %zu, number %zu: %g, %g",
                              surfaces[s], i, k, (double)a[k], (double)b[k]);
            }
        }
        cm_plan_destroy(plan);
        free_pictures(surface, source);
        free_pictures(surface, target);
        cm_surface_destroy(surface);
    }
}
END_TEST

/* Squares of what a filter is off, inside planes and near their edges. */
typedef struct off
{
    double square[2];
    size_t count[2];
} off;

static double decibels(const off *what, int is_near)
{
    return -10.0 * log10(what->square[is_near] / (double)what->count[is_near]);
}

/* Of values at directions all over the sphere; corners are left out, where faces meet whose edges are creased. */
static off measure(const char *name, double waves, cm_filter filter)
{
    enum
    {
        N = 20000
    };
    static double x[N], y[N], z[N], column[N], row[N];
    static float value[N];
    static uint8_t plane[N];
    off result = {{0}, {0}};
    cm_surface *surface = make_surface(name);
    cm_image source[PICTURES_MOST];
    make_pictures(surface, CM_PIXEL_FLOAT, 1, source);
    paint(surface, waves, source);
    for (int i = 0; i < N; i++)
    {
        /* R. Marques and others, Spherical Fibonacci point sets, 2013 */
        z[i] = 1.0 - (2.0 * i + 1.0) / N;
        x[i] = sqrt(1.0 - z[i] * z[i]) * cos(2.399963229728653 * i);
        y[i] = sqrt(1.0 - z[i] * z[i]) * sin(2.399963229728653 * i);
    }
    ck_assert_int_eq(cm_sample(surface, source, filter, N, x, y, z, value), CM_OK);
    cm_surface_positions(surface, N, x, y, z, plane, column, row);
    const double width = cm_surface_plane_width(surface);
    const double height = cm_surface_plane_height(surface);
    for (int i = 0; i < N; i++)
    {
        const double d[3] = {x[i], y[i], z[i]};
        const double error = (double)value[i] - scene_at(d, waves, 0);
        const double beside = fmin(column[i], width - column[i]);
        const double beyond = fmin(row[i], height - row[i]);
        const int is_near = beside < NEAR || beyond < NEAR;
        if (beside >= NEAR || beyond >= NEAR)
        {
            result.square[is_near] += error * error;
            result.count[is_near]++;
        }
    }
    free_pictures(surface, source);
    cm_surface_destroy(surface);
    return result;
}

START_TEST(seams_are_as_good_as_the_inside)
{
    static const struct
    {
        const char *name;
        double least; /* dB */
    } cases[] = {{"equirect;size=512", 110.0},      {"cube:coupled;size=128", 110.0},
                 {"cube:gnomonic;size=128", 110.0}, {"cube:qsc;size=128", 80.0},
                 {"cube:healpix;size=128", 75.0},   {"equirect;size=301;height=151", 100.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
        const off what = measure(cases[i].name, 12.0, CM_FILTER_BSPLINE5);
        const double inside = decibels(&what, 0), near = decibels(&what, 1);
        ck_assert_msg(inside >= cases[i].least, "%s: %.1f dB", cases[i].name, inside);
        ck_assert_msg(near >= inside - 1.0 || near >= 125.0, "%s: %.1f dB inside, %.1f near edges",
                      cases[i].name, inside, near);
    }
}
END_TEST

/* A power of the position, which splines of its degree have exactly. */
START_TEST(polynomials_of_degree_five_are_exact)
{
    enum
    {
        N = 1000
    };
    cm_surface *surface = make_surface("equirect;west=10;east=50;south=-20;north=20;size=96");
    cm_image source;
    static double column[N], row[N], x[N], y[N], z[N];
    static uint8_t plane[N];
    static float value[6 * N];
    make_pictures(surface, CM_PIXEL_FLOAT, 6, &source);
    for (size_t k = 0; k < 96 * 96; k++)
    {
        const double at = ((double)(k % 96) + 0.7 * (double)(k / 96) - 81.0) / 96.0;
        for (uint32_t c = 0; c < 6; c++)
        {
            put_number(&source, 0, k % 96, k / 96, c, pow(at, c));
        }
    }
    for (int i = 0; i < N; i++)
    {
        column[i] = 32.0 + 32.0 * fmod(0.618033988749895 * i, 1.0);
        row[i] = 32.0 + 32.0 * i / N;
    }
    cm_surface_directions(surface, N, plane, column, row, x, y, z);
    ck_assert_int_eq(cm_sample(surface, &source, CM_FILTER_BSPLINE5, N, x, y, z, value), CM_OK);
    for (int i = 0; i < 6 * N; i++)
    {
        const double at = (column[i / 6] - 0.5 + 0.7 * (row[i / 6] - 0.5) - 81.0) / 96.0;
        const double truth = pow(at, i % 6);
        ck_assert_msg(fabs((double)value[i] - truth) < 2e-6, "degree %d: %g for %g", i % 6,
                      (double)value[i], truth);
    }
    free_pictures(surface, &source);
    cm_surface_destroy(surface);
}
END_TEST

START_TEST(constants_stay_what_they_are)
{
    static const char *const small[] = {"equirect;size=1;height=1", "equirect;size=2;height=2",
                                        "cube:coupled;size=1",      "cube:gnomonic;size=2",
                                        "cube:qsc;size=3",          "equirect;size=16"};
    for (size_t s = 0; s < sizeof small / sizeof *small; s++)
    {
        cm_surface *surface = make_surface(small[s]);
        cm_image source[PICTURES_MOST];
        make_pictures(surface, CM_PIXEL_FLOAT, 5, source);
        for (size_t i = 0; i < cm_surface_picture_count(surface); i++)
        {
            for (size_t k = 0; k < picture_bytes(&source[i]) / sizeof(float); k++)
            {
                ((float *)source[i].data)[k] = 0.25f + 0.125f * (float)(k % 5);
            }
        }
        for (cm_filter filter = CM_FILTER_AUTO; filter <= CM_FILTER_BSPLINE5; filter++)
        {
            const double x[3] = {1.0, -0.3, 0.0}, y[3] = {0.0, 0.4, 0.0}, z[3] = {0.0, -0.5, 2.0};
            float value[15];
            ck_assert_int_eq(cm_sample(surface, source, filter, 3, x, y, z, value), CM_OK);
            for (int k = 0; k < 15; k++)
            {
                ck_assert_msg(fabsf(value[k] - (0.25f + 0.125f * (float)(k % 5))) < 2e-6f,
                              "%s, %s: %g", small[s], cm_filter_name(filter), (double)value[k]);
            }
        }
        free_pictures(surface, source);
        cm_surface_destroy(surface);
    }
}
END_TEST

START_TEST(bits_do_not_depend_on_threads_or_parts)
{
    check_same_bits("cube:coupled;size=40", "equirect;size=90;height=47", CM_FILTER_BSPLINE5);
    check_same_bits("equirect;size=140", "cube:gnomonic;size=37", CM_FILTER_BSPLINE5);
}
END_TEST

/* Fused or not, in vectors of any length: all instruction sets agree but for the last bits. */
START_TEST(instruction_sets_agree)
{
    cm_surface *from = make_surface("equirect;size=150"),
               *to = make_surface("cube:coupled;size=31");
    cm_image source[PICTURES_MOST], first[PICTURES_MOST], other[PICTURES_MOST];
    make_pictures(from, CM_PIXEL_FLOAT, 3, source);
    make_pictures(to, CM_PIXEL_FLOAT, 3, first);
    make_pictures(to, CM_PIXEL_FLOAT, 3, other);
    paint_noise(from, source);
    for (cm_filter filter = CM_FILTER_BSPLINE5; filter <= CM_FILTER_EWA; filter++)
    {
        for (size_t i = 0; i < cm_instructions_count(); i++)
        {
            const cm_plan_options options = {.size = sizeof options,
                                             .filter = filter,
                                             .tolerance = -1.0,
                                             .instructions = cm_instructions_at(i)};
            cm_plan *plan = NULL;
            ck_assert_int_eq(cm_plan_create(from, to, &options, &plan), CM_OK);
            ck_assert_int_eq(cm_resample(plan, source, i == 0 ? first : other, (cm_rows){0}),
                             CM_OK);
            for (size_t k = 0; i > 0 && k < 6 * 31 * 31 * 3; k++)
            {
                const float a = ((float *)first[k / 2883].data)[k % 2883];
                const float b = ((float *)other[k / 2883].data)[k % 2883];
                ck_assert_msg(fabsf(a - b) < 2e-5f, "%s, %s: %g, %g", cm_filter_name(filter),
                              cm_instructions_at(i), (double)a, (double)b);
            }
            cm_plan_destroy(plan);
        }
    }
    free_pictures(from, source);
    free_pictures(to, first);
    free_pictures(to, other);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
}
END_TEST

START_TEST(what_cannot_be_sampled_is_an_error)
{
    cm_surface *surface = make_surface("equirect;west=0;east=90;south=0;north=45;size=8");
    cm_image source;
    const double x[2] = {-1.0, 1.0}, y[2] = {0.0, 1.0}, z[2] = {0.0, 0.5};
    float value[2] = {7.0f, 7.0f};
    make_pictures(surface, CM_PIXEL_U8, 1, &source);
    memset(source.data, 255, picture_bytes(&source));
    ck_assert_int_eq(cm_sample(surface, &source, CM_FILTER_EWA, 2, x, y, z, value),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_sample(NULL, &source, CM_FILTER_NEAREST, 2, x, y, z, value),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_sample(surface, &source, CM_FILTER_NEAREST, 2, NULL, y, z, value),
                     CM_ERROR_ARGUMENT);
    ck_assert_msg(value[0] == 7.0f, "%g", (double)value[0]);
    ck_assert_int_eq(cm_sample(surface, &source, CM_FILTER_BSPLINE5, 2, x, y, z, value), CM_OK);
    ck_assert_msg(value[0] == 0.0f, "%g", (double)value[0]);
    ck_assert_msg(fabsf(value[1] - 1.0f) < 1e-6f, "%g", (double)value[1]);
    ck_assert_int_eq(cm_sample(surface, &source, CM_FILTER_BSPLINE5, 0, NULL, NULL, NULL, NULL),
                     CM_OK);
    free_pictures(surface, &source);
    cm_surface_destroy(surface);
}
END_TEST

/* Faces of HOLED pixels, and of SHOWN: places are in proportion. */
enum
{
    HOLED = 32,
    SHOWN = 50
};

/* The values of face 0 when numbers of it are put in place of the scene's. */
static void show_holes(const float *number, size_t column, size_t row, size_t wide, size_t high,
                       float shown[SHOWN * SHOWN])
{
    cm_surface *from = make_surface("cube;size=32"), *to = make_surface("cube;size=50");
    cm_image source[PICTURES_MOST], target[PICTURES_MOST];
    make_pictures(from, CM_PIXEL_FLOAT, 1, source);
    make_pictures(to, CM_PIXEL_FLOAT, 1, target);
    paint(from, 3.0, source);
    for (size_t i = 0; i < wide * high && number != NULL; i++)
    {
        put_number(source, 0, column + i % wide, row + i / wide, 0, (double)*number);
    }
    cm_plan *plan = make_plan(from, to, CM_FILTER_BSPLINE5);
    ck_assert_int_eq(cm_resample(plan, source, target, (cm_rows){0}), CM_OK);
    memcpy(shown, target->data, SHOWN * SHOWN * sizeof *shown);
    cm_plan_destroy(plan);
    free_pictures(from, source);
    free_pictures(to, target);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
}

/* How many pixels a place is away from the nearest of a run. */
static double pixels_away(double place, size_t first, size_t count)
{
    return fmax(fmax((double)first + 0.5 - place, place - (double)(first + count) + 0.5), 0.0);
}

/* What is no number is where six pixels touch it, and changes little elsewhere: a patch, a pixel in the corner, half of a
 * face, all of it. */
START_TEST(what_is_no_number_stays_where_it_is)
{
    static const float numbers[] = {NAN, INFINITY, -INFINITY, 3e38f};
    static const size_t places[][4] = {
        {12, 20, 1, 1}, {8, 9, 5, 3}, {0, 0, 1, 1}, {0, 16, 32, 16}, {0, 0, 32, 32}};
    static float whole[SHOWN * SHOWN], holed[SHOWN * SHOWN];
    show_holes(NULL, 0, 0, 0, 0, whole);
    for (size_t i = 0; i < 4 * sizeof places / sizeof *places; i++)
    {
        const size_t *at = places[i / 4];
        show_holes(&numbers[i % 4], at[0], at[1], at[2], at[3], holed);
        for (size_t k = 0; k < SHOWN * SHOWN; k++)
        {
            const double x = ((double)(k % SHOWN) + 0.5) * HOLED / SHOWN;
            const double y = ((double)(k / SHOWN) + 0.5) * HOLED / SHOWN;
            const double away = fmax(pixels_away(x, at[0], at[2]), pixels_away(y, at[1], at[3]));
            const double change = fabs((double)holed[k] - (double)whole[k]);
            ck_assert_msg((isnan(change) != 0) == (away < 3.0), "%zu: %g at %g, %g", i, change, x,
                          y);
            ck_assert_msg(isnan(change) ||
                              change < (at[2] > 1 ? 0.05 : 0.01) * pow(0.5, away - 3.0),
                          "%zu: %g at %g, %g", i, change, x, y);
        }
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {the_spline_goes_through_all_pixels,
                                  seams_are_as_good_as_the_inside,
                                  polynomials_of_degree_five_are_exact,
                                  constants_stay_what_they_are,
                                  bits_do_not_depend_on_threads_or_parts,
                                  instruction_sets_agree,
                                  what_cannot_be_sampled_is_an_error,
                                  what_is_no_number_stays_where_it_is,
                                  NULL};
    return run_suite("splines", tests);
}
