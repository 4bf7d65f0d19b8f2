/* SPDX-License-Identifier: MIT
 *
 * HEALPix: maps of other resolutions and orders, against a plain reference: for each pixel of the finer map the
 * pixel of the coarser that its centre is in.
 */
#include "healpix_suite.h"

enum
{
    SIDE_MAX = 16,
    COUNT_MAX = 12 * SIDE_MAX * SIDE_MAX
};

typedef struct reference
{
    double sum[COUNT_MAX];
    int count[COUNT_MAX];
    int parts[COUNT_MAX];
} reference;

static int is_bad(double value)
{
    return !isfinite(value) || fabs(value / CM_HEALPIX_UNSEEN - 1.0) < 1e-5;
}

static int64_t container(const cm_healpix *fine, int64_t pixel, const cm_healpix *coarse)
{
    double d[3];
    centre_of(fine, pixel, d);
    return pixel_of(coarse, d);
}

static void sum_parts(const cm_healpix *from, const double *map, const cm_healpix *to,
                      reference *made)
{
    memset(made, 0, sizeof *made);
    for (int64_t pixel = 0; pixel < cm_healpix_pixel_count(from); pixel++)
    {
        int64_t at = container(from, pixel, to);
        made->parts[at]++;
        if (!is_bad(map[pixel]))
        {
            made->sum[at] += map[pixel];
            made->count[at]++;
        }
    }
}

/* Of one pixel of to; NaN if it is bad. */
static double expected_value(const cm_healpix *from, const double *map, const cm_healpix *to,
                             const reference *sums, int64_t pixel,
                             const cm_healpix_regrade_options *options)
{
    double value;
    if (cm_healpix_nside(to) > cm_healpix_nside(from))
    {
        value = map[container(to, pixel, from)];
    }
    else
    {
        value = sums->count[pixel] == 0 ? (double)NAN : sums->sum[pixel] / sums->count[pixel];
        value = options->is_pessimistic && sums->count[pixel] < sums->parts[pixel] ? (double)NAN
                                                                                   : value;
    }
    double ratio = (double)cm_healpix_nside(from) / (double)cm_healpix_nside(to);
    return is_bad(value) ? (double)NAN : value / pow(ratio, options->power);
}

static void require_value(double value, double expected, double tolerance, int bad_is_nan,
                          int64_t pixel)
{
    if (isnan(expected))
    {
        double unseen = tolerance > 1e-9 ? (double)(float)CM_HEALPIX_UNSEEN : CM_HEALPIX_UNSEEN;
        REQUIRE(bad_is_nan ? isnan(value) : value == unseen, "pixel %lld: %g, but it is bad",
                (long long)pixel, value);
        return;
    }
    REQUIRE(fabs(value - expected) <= tolerance * fabs(expected) + tolerance,
            "pixel %lld: %.17g, not %.17g", (long long)pixel, value, expected);
}

static void compare(const cm_healpix *from, const cm_healpix *to, const double *map,
                    const cm_healpix_regrade_options *options)
{
    static reference sums;
    static double result[COUNT_MAX + 1];
    static float narrow[COUNT_MAX];
    static float narrow_result[COUNT_MAX + 1];
    int64_t count = cm_healpix_pixel_count(to);
    for (int64_t i = 0; i < cm_healpix_pixel_count(from); i++)
    {
        narrow[i] = (float)map[i];
    }
    result[count] = 7.0;
    narrow_result[count] = 7.0f;
    REQUIRE(cm_healpix_regrade(from, map, to, result, options) == CM_OK &&
                cm_healpix_regrade_f32(from, narrow, to, narrow_result, options) == CM_OK,
            "%lld to %lld", (long long)cm_healpix_nside(from), (long long)cm_healpix_nside(to));
    sum_parts(from, map, to, &sums);
    for (int64_t pixel = 0; pixel < count; pixel++)
    {
        double expected = expected_value(from, map, to, &sums, pixel, options);
        require_value(result[pixel], expected, 1e-14, options->bad_is_nan, pixel);
        require_value(narrow_result[pixel], expected, 1e-6, options->bad_is_nan, pixel);
    }
    REQUIRE(result[count] == 7.0 && narrow_result[count] == 7.0f, "written beyond the end");
}

static void fill_map(double *map, uint64_t *state)
{
    static const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY,
                                 CM_HEALPIX_UNSEEN, (double)(float)CM_HEALPIX_UNSEEN};
    for (int i = 0; i < COUNT_MAX; i++)
    {
        map[i] = 3.0 + next_real(state);
        /* whole regions, so that pixels of coarse maps are bad, too, and single ones */
        if (i / 64 % 5 == 2 || next_bits(state) % 19 == 0)
        {
            map[i] = bad[next_bits(state) % 5];
        }
    }
}

START_TEST(maps_of_all_resolutions)
{
    static double map[COUNT_MAX];
    uint64_t state = 17;
    for (int64_t a = 1; a <= SIDE_MAX; a *= 2)
    {
        for (int64_t b = 1; b <= SIDE_MAX; b *= 2)
        {
            for (int orders = 0; orders < 4; orders++)
            {
                cm_healpix *from = make_healpix(a, (cm_healpix_order)(orders % 2), NULL);
                cm_healpix *to = make_healpix(b, (cm_healpix_order)(orders / 2), NULL);
                for (int i = 0; i < 8; i++)
                {
                    const cm_healpix_regrade_options options = {.size = sizeof options,
                                                                .is_pessimistic = i & 1,
                                                                .bad_is_nan = i >> 1 & 1,
                                                                .power = i & 4 ? -2.0 : 0.0};
                    fill_map(map, &state);
                    compare(from, to, map, &options);
                }
                cm_healpix_destroy(from);
                cm_healpix_destroy(to);
            }
        }
    }
}
END_TEST

/* Counts stay the same in sum, whatever nside. */
START_TEST(sums_are_kept)
{
    static double map[COUNT_MAX];
    static double coarse[COUNT_MAX];
    static double fine[COUNT_MAX];
    const cm_healpix_regrade_options options = {.size = sizeof options, .power = -2.0};
    cm_healpix *a = make_healpix(8, CM_HEALPIX_RING, NULL);
    cm_healpix *b = make_healpix(2, CM_HEALPIX_NESTED, NULL);
    cm_healpix *c = make_healpix(16, CM_HEALPIX_RING, NULL);
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < 12 * 64; i++)
    {
        map[i] = i % 11;
        sum[0] += map[i];
    }
    ck_assert_int_eq(cm_healpix_regrade(a, map, b, coarse, &options), CM_OK);
    ck_assert_int_eq(cm_healpix_regrade(b, coarse, c, fine, &options), CM_OK);
    for (int i = 0; i < 12 * 256; i++)
    {
        sum[1] += i < 48 ? coarse[i] : 0.0;
        sum[2] += fine[i];
    }
    ck_assert_double_eq_tol(sum[1], sum[0], 1e-9);
    ck_assert_double_eq_tol(sum[2], sum[0], 1e-9);
    cm_healpix_destroy(a);
    cm_healpix_destroy(b);
    cm_healpix_destroy(c);
}
END_TEST

/* What rounding takes from a sum of many parts is added again. */
START_TEST(sums_are_exact)
{
    static double map[COUNT_MAX];
    double result[12];
    cm_healpix *from = make_healpix(16, CM_HEALPIX_NESTED, NULL);
    cm_healpix *to = make_healpix(1, CM_HEALPIX_RING, NULL);
    for (int i = 0; i < COUNT_MAX; i++)
    {
        map[i] = i % 4 == 0 ? 1e17 : i % 4 == 2 ? -1e17 : 1.0;
    }
    ck_assert_int_eq(cm_healpix_regrade(from, map, to, result, NULL), CM_OK);
    for (int i = 0; i < 12; i++)
    {
        ck_assert_double_eq(result[i], 0.5);
    }
    for (int i = 0; i < COUNT_MAX; i++)
    {
        map[i] = 1e308;
    }
    ck_assert_int_eq(cm_healpix_regrade(from, map, to, result, NULL), CM_OK);
    ck_assert(isinf(result[0]));
    cm_healpix_destroy(from);
    cm_healpix_destroy(to);
}
END_TEST

/* Floats beside the ends of what is UNSEEN: a map that is copied has what one has that goes through double, as another order does. */
START_TEST(unseen_floats)
{
    float map[192], copied[192], ordered[192];
    int64_t ring[192];
    int counts[2] = {0, 0};
    cm_healpix *nested = make_healpix(4, CM_HEALPIX_NESTED, NULL);
    cm_healpix *rings = make_healpix(4, CM_HEALPIX_RING, NULL);
    for (int i = 0; i < 192; i++)
    {
        const int steps = i % 96 - 48;
        float value = (float)(CM_HEALPIX_UNSEEN * (1.0 + (i < 96 ? 1e-5 : -1e-5)));
        for (int k = 0; k < abs(steps); k++)
        {
            value = nextafterf(value, steps < 0 ? -INFINITY : INFINITY);
        }
        map[i] = value;
    }
    map[0] = NAN;
    map[1] = INFINITY;
    map[2] = -INFINITY;
    map[3] = -0.0f;
    const cm_healpix_regrade_options options = {
        .size = sizeof options, .bad_is_nan = 1, .power = 3.0};
    ck_assert_int_eq(cm_healpix_regrade_f32(nested, map, nested, copied, &options), CM_OK);
    ck_assert_int_eq(cm_healpix_regrade_f32(nested, map, rings, ordered, &options), CM_OK);
    for (int64_t i = 0; i < 192; i++)
    {
        ring[i] = i;
    }
    cm_healpix_ring_from_nested_array(rings, 192, ring, ring);
    for (int i = 0; i < 192; i++)
    {
        ck_assert(memcmp(&copied[i], &ordered[ring[i]], sizeof(float)) == 0);
        counts[isnan(copied[i]) != 0]++;
    }
    ck_assert(counts[0] > 80 && counts[1] > 80);
    cm_healpix_destroy(nested);
    cm_healpix_destroy(rings);
}
END_TEST

START_TEST(what_cannot_be)
{
    double map[12 * 9];
    double result[12 * 9] = {7.0};
    float narrow[12 * 9] = {7.0f};
    cm_healpix *three = make_healpix(3, CM_HEALPIX_RING, NULL);
    cm_healpix *other = make_healpix(3, CM_HEALPIX_RING, NULL);
    cm_healpix *two = make_healpix(2, CM_HEALPIX_RING, NULL);
    cm_healpix_regrade_options options = {.size = sizeof options};
    for (int i = 0; i < 108; i++)
    {
        map[i] = i;
    }
    ck_assert_int_eq(cm_healpix_regrade(three, map, two, result, NULL), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_regrade(two, map, three, result, NULL), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_regrade(NULL, map, two, result, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_healpix_regrade(two, map, NULL, result, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_healpix_regrade(two, NULL, two, result, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_healpix_regrade(two, map, two, NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_healpix_regrade_f32(two, NULL, two, narrow, NULL), CM_ERROR_ARGUMENT);
    options.power = (double)NAN;
    ck_assert_int_eq(cm_healpix_regrade(two, map, two, result, &options), CM_ERROR_ARGUMENT);
    options = (cm_healpix_regrade_options){.size = 3};
    ck_assert_int_eq(cm_healpix_regrade(two, map, two, result, &options), CM_ERROR_ARGUMENT);
    ck_assert(result[0] == 7.0 && narrow[0] == 7.0f);
    ck_assert_int_eq(cm_healpix_regrade(three, map, other, result, NULL), CM_OK);
    ck_assert(result[107] == 107.0);
    cm_healpix_destroy(three);
    cm_healpix_destroy(other);
    cm_healpix_destroy(two);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {maps_of_all_resolutions, sums_are_kept,  sums_are_exact,
                            unseen_floats,           what_cannot_be, NULL};
    return run_suite("healpix maps", tests);
}
