/* SPDX-License-Identifier: MIT
 *
 * Samples of colour maps, and saturations that fit the gamut.
 */
#include "many_colormaps.h"

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

int main(void)
{
    const TTest *const tests[] = {no_places,        samples, classes_are_apart,
                                  largest_chroma,   fit,     a_bit_more_is_clipped,
                                  fit_of_pale_ends, NULL};
    return run_suite("colormap samples", tests);
}
