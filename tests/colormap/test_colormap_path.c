/* SPDX-License-Identifier: MIT
 *
 * The paths of colour maps: those of the paper, their ends, halves, hues and corners.
 */
#include "many_colormaps.h"

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

int main(void)
{
    const TTest *const tests[] = {
        paths_are_those_of_the_paper, ends_are_exact,     lightness_grows, halves_are_alike,
        the_shorter_way_round,        hues_are_below_360, corners,         NULL};
    return run_suite("colormap path", tests);
}
