/* SPDX-License-Identifier: MIT
 *
 * Places of samples whose colours are evenly apart, measured by conversions of the tests' own.
 */
#include "many_colormaps.h"

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

int main(void)
{
    const TTest *const tests[] = {samples_of_standard_maps_are_even,
                                  samples_are_even_with_every_number,
                                  samples_of_other_maps_are_even,
                                  places_of_few_samples,
                                  samples_of_many_stops,
                                  places_without_corners,
                                  places_of_enormous_numbers,
                                  NULL};
    return run_suite("colormap evenness", tests);
}
