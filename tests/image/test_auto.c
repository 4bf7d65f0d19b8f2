/* SPDX-License-Identifier: MIT
 *
 * Which filter auto takes, and that it says so.
 */
#include "tests/image/round_scene.h"

static cm_filter chosen(const char *from_name, const char *to_name, cm_pixel_type type,
                        double waves)
{
    cm_surface *from = make_surface(from_name), *to = make_surface(to_name);
    cm_image source[PICTURES_MOST];
    cm_source *made[2] = {NULL, NULL};
    make_pictures(from, type, 3, source);
    if (waves < 0.0)
    {
        paint_noise(from, source);
    }
    else
    {
        paint(from, waves, source);
    }
    cm_plan *plan = make_plan(from, to, CM_FILTER_AUTO);
    ck_assert_int_eq(cm_source_create(plan, source, type, 1, &made[0]), CM_OK);
    ck_assert_int_eq(cm_source_create(plan, source, type, 3, &made[1]), CM_OK);
    const cm_filter filter = cm_source_filter(made[0]);
    ck_assert_int_eq(filter, cm_source_filter(made[1]));
    cm_source_destroy(made[0]);
    cm_source_destroy(made[1]);
    cm_plan_destroy(plan);
    free_pictures(from, source);
    cm_surface_destroy(from);
    cm_surface_destroy(to);
    return filter;
}

START_TEST(what_is_a_permutation_is_copied)
{
    ck_assert_int_eq(
        chosen("cube:coupled;size=64", "cube:coupled;size=64;frame=gl", CM_PIXEL_U8, -1.0),
        CM_FILTER_NEAREST);
    ck_assert_int_eq(chosen("equirect;size=64", "equirect;size=64", CM_PIXEL_FLOAT, 3.0),
                     CM_FILTER_NEAREST);
    ck_assert_int_ne(chosen("equirect;size=64", "equirect;size=66", CM_PIXEL_FLOAT, 3.0),
                     CM_FILTER_NEAREST);
}
END_TEST

START_TEST(what_minifies_has_footprints)
{
    ck_assert_int_eq(chosen("equirect;size=512", "cube:gnomonic;size=64", CM_PIXEL_U8, 3.0),
                     CM_FILTER_EWA);
    ck_assert_int_eq(
        chosen("cube:coupled;size=96", "cube:coupled;size=64;frame=gl", CM_PIXEL_FLOAT, 3.0),
        CM_FILTER_EWA);
    /* one way only */
    ck_assert_int_eq(
        chosen("equirect;size=512;height=128", "equirect;size=128;height=128", CM_PIXEL_U8, 3.0),
        CM_FILTER_EWA);
    /* meridians that meet are no minification */
    ck_assert_int_ne(chosen("equirect;size=256", "cube:coupled;size=80", CM_PIXEL_U8, 3.0),
                     CM_FILTER_EWA);
}
END_TEST

START_TEST(smooth_pictures_have_cheap_filters)
{
    static const char from[] = "cube:coupled;size=64", to[] = "cube:gnomonic;size=96";
    ck_assert_int_eq(chosen(from, to, CM_PIXEL_U8, 2.0), CM_FILTER_BILINEAR);
    ck_assert_int_eq(chosen(from, to, CM_PIXEL_U8, -1.0), CM_FILTER_BSPLINE5);
    ck_assert_int_eq(chosen(from, to, CM_PIXEL_FLOAT, -1.0), CM_FILTER_BSPLINE5);
    /* what has shorter waves has no cheaper filter */
    int before = 0;
    for (double waves = 1.0; waves < 64.0; waves *= 1.5)
    {
        static const int rank[] = {0, 0, 1, 2, 0, 0, 3, 4, 5};
        const int now = rank[chosen(from, to, CM_PIXEL_U8, waves)];
        ck_assert_msg(now >= before && now <= 4, "%g waves: %d after %d", waves, now, before);
        before = now;
    }
    ck_assert_int_gt(before, 1);
}
END_TEST

/* The error that auto allows is there in the result. */
START_TEST(the_result_is_as_good_as_is_said)
{
    static const char from_name[] = "cube:coupled;size=64", to_name[] = "cube:gnomonic;size=96";
    for (double waves = 1.0; waves < 40.0; waves *= 2.0)
    {
        cm_surface *from = make_surface(from_name), *to = make_surface(to_name);
        cm_image source[PICTURES_MOST], target[2][PICTURES_MOST];
        make_pictures(from, CM_PIXEL_FLOAT, 1, source);
        paint(from, waves, source);
        double sum = 0.0, least = 1.0, most = 0.0;
        for (int k = 0; k < 2; k++)
        {
            cm_plan *plan = make_plan(from, to, k == 0 ? CM_FILTER_AUTO : CM_FILTER_BSPLINE5);
            make_pictures(to, CM_PIXEL_FLOAT, 1, target[k]);
            ck_assert_int_eq(cm_resample(plan, source, target[k], (cm_rows){0}), CM_OK);
            cm_plan_destroy(plan);
        }
        for (size_t i = 0; i < 6; i++)
        {
            for (size_t k = 0; k < 96 * 96; k++)
            {
                const double a = (double)((float *)target[0][i].data)[k];
                const double b = (double)((float *)target[1][i].data)[k];
                sum += (a - b) * (a - b);
                least = fmin(least, b);
                most = fmax(most, b);
            }
        }
        const double off = sqrt(sum / (6 * 96 * 96));
        ck_assert_msg(off <= 2e-4 * (most - least), "%g waves: %g of %g", waves, off, most - least);
        free_pictures(from, source);
        free_pictures(to, target[0]);
        free_pictures(to, target[1]);
        cm_surface_destroy(from);
        cm_surface_destroy(to);
    }
}
END_TEST

START_TEST(small_pictures_have_an_answer)
{
    static const char *const small[] = {"equirect;size=1;height=1", "cube:coupled;size=1",
                                        "cube:gnomonic;size=2", "equirect;size=3;height=2"};
    for (size_t i = 0; i < 4; i++)
    {
        for (size_t k = 0; k < 4; k++)
        {
            ck_assert_int_ne(chosen(small[i], small[k], CM_PIXEL_FLOAT, 1.0), CM_FILTER_AUTO);
        }
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        what_is_a_permutation_is_copied,    what_minifies_has_footprints,
        smooth_pictures_have_cheap_filters, the_result_is_as_good_as_is_said,
        small_pictures_have_an_answer,      NULL};
    return run_suite("auto", tests);
}
