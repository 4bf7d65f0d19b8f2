/* SPDX-License-Identifier: MIT
 *
 * HEALPix: numbers of pixels, points to pixels and back, arrays, bad input.
 */
#include "healpix_suite.h"

static const double pi = 3.14159265358979323846;

START_TEST(resolutions)
{
    char message[120];
    cm_healpix *healpix = NULL;
    ck_assert_int_eq(cm_healpix_check(3, CM_HEALPIX_RING, message, sizeof message), CM_OK);
    ck_assert_int_eq(cm_healpix_check(CM_HEALPIX_NSIDE_MAX, CM_HEALPIX_NESTED, NULL, 0), CM_OK);
    ck_assert_int_eq(cm_healpix_check(0, CM_HEALPIX_RING, message, sizeof message), CM_ERROR_PIXEL);
    ck_assert_ptr_nonnull(strstr(message, "nside is 0"));
    ck_assert_int_eq(
        cm_healpix_check((int64_t)CM_HEALPIX_NSIDE_MAX + 1, CM_HEALPIX_RING, message, 9),
        CM_ERROR_PIXEL);
    ck_assert_uint_eq(strlen(message), 8);
    ck_assert_int_eq(cm_healpix_check(-4, CM_HEALPIX_NESTED, NULL, 0), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_check(INT64_MIN, CM_HEALPIX_NESTED, NULL, 0), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_check(12, CM_HEALPIX_NESTED, message, sizeof message),
                     CM_ERROR_PIXEL);
    ck_assert_ptr_nonnull(strstr(message, "power of two"));
    ck_assert_int_eq(cm_healpix_check(4, (cm_healpix_order)2, message, sizeof message),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_healpix_create(4, CM_HEALPIX_RING, NULL, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_healpix_create(6, CM_HEALPIX_NESTED, NULL, &healpix), CM_ERROR_PIXEL);
    cm_options options = {.size = 1};
    ck_assert_int_eq(cm_healpix_create(4, CM_HEALPIX_RING, &options, &healpix), CM_ERROR_ARGUMENT);
    options = (cm_options){.size = sizeof options, .tier = (cm_tier)7};
    ck_assert_int_eq(cm_healpix_create(4, CM_HEALPIX_RING, &options, &healpix), CM_ERROR_ARGUMENT);
    options.tier = (cm_tier)-1;
    ck_assert_int_eq(cm_healpix_create(4, CM_HEALPIX_RING, &options, &healpix), CM_ERROR_ARGUMENT);
    options = (cm_options){.size = sizeof options, .instructions = "mmx"};
    ck_assert_int_eq(cm_healpix_create(4, CM_HEALPIX_RING, &options, &healpix),
                     CM_ERROR_INSTRUCTIONS);
    ck_assert_ptr_null(healpix);
    healpix = make_healpix(CM_HEALPIX_NSIDE_MAX, CM_HEALPIX_NESTED, NULL);
    ck_assert_int_eq(cm_healpix_nside(healpix), CM_HEALPIX_NSIDE_MAX);
    ck_assert_int_eq(cm_healpix_order_of(healpix), CM_HEALPIX_NESTED);
    ck_assert_int_eq(cm_healpix_pixel_count(healpix), 3458764513820540928);
    ck_assert_int_eq(cm_healpix_ring_count(healpix), 2147483647);
    cm_healpix_destroy(healpix);
    cm_healpix_destroy(NULL);
    ck_assert_int_eq(cm_healpix_create(4, CM_HEALPIX_RING, NULL, &healpix), CM_OK);
    ck_assert_int_eq(cm_instructions_check(cm_healpix_instructions(healpix), NULL, 0), CM_OK);
    cm_healpix_destroy(healpix);
}
END_TEST

/* ---- There and back ---- */

static void check_pixel(const cm_healpix *healpix, int64_t pixel)
{
    double d[3];
    double theta;
    double phi;
    double lonlat[2];
    int64_t back = -7;
    centre_of(healpix, pixel, d);
    REQUIRE(fabs(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - 1.0) < 1e-15, PIXEL_FORMAT,
            PIXEL_OF(healpix, pixel));
    REQUIRE(pixel_of(healpix, d) == pixel, PIXEL_FORMAT, PIXEL_OF(healpix, pixel));
    REQUIRE(cm_healpix_angles_from_pixel(healpix, pixel, &theta, &phi) == CM_OK &&
                cm_healpix_pixel_from_angles(healpix, theta, phi, &back) == CM_OK && back == pixel,
            PIXEL_FORMAT ": angles", PIXEL_OF(healpix, pixel));
    REQUIRE(theta > 0.0 && theta < pi && phi >= 0.0 && phi < 2.0 * pi, "%g %g", theta, phi);
    REQUIRE(fabs(cos(theta) - d[2]) < 5e-16 && fabs(sin(theta) * cos(phi) - d[0]) < 1.3e-15 &&
                fabs(sin(theta) * sin(phi) - d[1]) < 1.3e-15,
            PIXEL_FORMAT ": angles", PIXEL_OF(healpix, pixel));
    REQUIRE(cm_healpix_lonlat_from_pixel(healpix, pixel, lonlat) == CM_OK &&
                cm_healpix_pixel_from_lonlat(healpix, lonlat[0], lonlat[1], &back) == CM_OK &&
                back == pixel,
            PIXEL_FORMAT ": lon, lat", PIXEL_OF(healpix, pixel));
    REQUIRE(lonlat[0] >= -pi && lonlat[0] < pi && fabs(0.5 * pi - theta - lonlat[1]) < 7e-16 &&
                fabs(remainder(lonlat[0] - phi, 2.0 * pi)) < 2e-15,
            PIXEL_FORMAT ": lon, lat", PIXEL_OF(healpix, pixel));
}

static void check_numbers(const cm_healpix *healpix, int64_t pixel)
{
    int64_t nested = -7;
    int64_t ring = -7;
    if (!is_power_of_two(cm_healpix_nside(healpix)))
    {
        REQUIRE(cm_healpix_nested_from_ring(healpix, pixel, &nested) == CM_ERROR_PIXEL &&
                    cm_healpix_ring_from_nested_array(healpix, 1, &pixel, &ring) ==
                        CM_ERROR_PIXEL &&
                    nested == -7 && ring == -7,
                PIXEL_FORMAT, PIXEL_OF(healpix, pixel));
        return;
    }
    REQUIRE(cm_healpix_nested_from_ring(healpix, pixel, &nested) == CM_OK &&
                cm_healpix_ring_from_nested(healpix, nested, &ring) == CM_OK && ring == pixel,
            PIXEL_FORMAT ": %lld in NESTED", PIXEL_OF(healpix, pixel), (long long)nested);
    REQUIRE(cm_healpix_ring_from_nested(healpix, pixel, &ring) == CM_OK &&
                cm_healpix_nested_from_ring(healpix, ring, &nested) == CM_OK && nested == pixel,
            PIXEL_FORMAT ": %lld in RING", PIXEL_OF(healpix, pixel), (long long)ring);
}

static void check_all_pixels(const cm_healpix *healpix)
{
    double sum[3] = {0.0, 0.0, 0.0};
    for (int64_t pixel = 0; pixel < cm_healpix_pixel_count(healpix); pixel++)
    {
        double d[3];
        check_pixel(healpix, pixel);
        check_numbers(healpix, pixel);
        centre_of(healpix, pixel, d);
        for (int k = 0; k < 3; k++)
        {
            sum[k] += d[k];
        }
    }
    REQUIRE(fabs(sum[0]) + fabs(sum[1]) + fabs(sum[2]) < 1e-12, "nside %lld",
            (long long)cm_healpix_nside(healpix));
}

START_TEST(every_pixel_of_small_maps)
{
    for_small(check_all_pixels);
}
END_TEST

/* What chealpix 3.30 says. */
START_TEST(known_numbers)
{
    cm_healpix *ring = make_healpix(4, CM_HEALPIX_RING, NULL);
    static const int64_t pairs[][2] = {{0, 15},  {3, 63},   {4, 14},   {5, 13},    {40, 79},
                                       {88, 70}, {103, 73}, {104, 67}, {188, 128}, {191, 176}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    {
        int64_t nested = -7;
        ck_assert_int_eq(cm_healpix_nested_from_ring(ring, pairs[i][0], &nested), CM_OK);
        ck_assert_int_eq(nested, pairs[i][1]);
    }
    cm_healpix_destroy(ring);
}
END_TEST

/* Pixels beside the borders of rings, of caps and of base pixels at the greatest nside. */
START_TEST(hard_pixels_of_the_finest_map)
{
    const int64_t nside = CM_HEALPIX_NSIDE_MAX;
    uint64_t state = 8;
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        cm_healpix *ring = make_healpix(nside, CM_HEALPIX_RING, cm_instructions_at(s));
        cm_healpix *nested = make_healpix(nside, CM_HEALPIX_NESTED, cm_instructions_at(s));
        for (int i = 0; i < 20000; i++)
        {
            cm_healpix_ring info = {.size = sizeof info};
            double size = exp2(15.5 * (1.0 + next_real(&state)));
            int64_t number = (int64_t)fmin(size, 4.0 * (double)nside - 1.0);
            number = i % 7 == 1   ? nside - i / 7 % 3 + 1
                     : i % 7 == 2 ? 3 * nside + i / 7 % 3 - 1
                     : i % 2 == 0 ? number
                                  : 4 * nside - number;
            REQUIRE(cm_healpix_ring_info(ring, number, &info) == CM_OK, "%lld", (long long)number);
            check_pixel(ring, info.first);
            check_numbers(ring, info.first);
            check_pixel(ring, info.first + info.count - 1);
            check_numbers(ring, info.first + info.count - 1);
            check_numbers(ring, (int64_t)(next_bits(&state) % (uint64_t)(12 * nside * nside)));
            check_pixel(nested, (int64_t)(next_bits(&state) % (uint64_t)(12 * nside * nside)));
        }
        cm_healpix_destroy(ring);
        cm_healpix_destroy(nested);
    }
}
END_TEST

/* ---- Points ---- */

/* However short or long a direction is, and however near the pole: the four first pixels are about it, and
 * their corners 1.3e-9 from it. */
START_TEST(poles)
{
    static const double colatitudes[] = {0.0, 5e-324, 1e-310, 1e-300, 1e-160, 1e-15, 1e-10, 1e-9};
    const int64_t nside = CM_HEALPIX_NSIDE_MAX;
    cm_healpix *healpix = make_healpix(nside, CM_HEALPIX_RING, NULL);
    int64_t last = cm_healpix_pixel_count(healpix) - 1;
    for (size_t i = 0; i < sizeof colatitudes / sizeof *colatitudes; i++)
    {
        for (int quarter = 0; quarter < 4; quarter++)
        {
            double c = colatitudes[i];
            double lon = 0.5 * pi * quarter + 0.3;
            const double north[3] = {c * cos(lon), c * sin(lon), 1.0};
            const double south[3] = {c * cos(lon), c * sin(lon), -1.0};
            int64_t pixel = -7;
            /* the longitude of subnormal numbers is rough, and a pole has that of its signs */
            if (c > 1e-300)
            {
                ck_assert_int_eq(pixel_of(healpix, north), quarter);
                ck_assert_int_eq(pixel_of(healpix, south), last - 3 + quarter);
            }
            ck_assert_int_lt(pixel_of(healpix, north), 4);
            ck_assert_int_gt(pixel_of(healpix, south), last - 4);
            ck_assert_int_eq(cm_healpix_pixel_from_angles(healpix, c, lon, &pixel), CM_OK);
            ck_assert_int_eq(pixel, quarter);
            ck_assert_int_eq(cm_healpix_pixel_from_angles(healpix, pi, lon, &pixel), CM_OK);
            ck_assert_int_eq(pixel, last - 3 + quarter);
            ck_assert_int_eq(cm_healpix_pixel_from_lonlat(healpix, lon, 0.5 * pi, &pixel), CM_OK);
            ck_assert_int_eq(pixel, quarter);
        }
    }
    cm_healpix_destroy(healpix);
}
END_TEST

START_TEST(lengths_do_not_count)
{
    static const double lengths[] = {1e-290, 1e-160, 1e-100, 1e-10, 1.0, 3.0, 1e100, 1e160, 1e305};
    uint64_t state = 5;
    cm_healpix *healpix = make_healpix(1024, CM_HEALPIX_NESTED, NULL);
    for (int i = 0; i < 20000; i++)
    {
        double d[3];
        next_direction(&state, d);
        int64_t pixel = pixel_of(healpix, d);
        for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++)
        {
            const double scaled[3] = {d[0] * lengths[k], d[1] * lengths[k], d[2] * lengths[k]};
            REQUIRE(pixel_of(healpix, scaled) == pixel, "%g %g %g times %g", d[0], d[1], d[2],
                    lengths[k]);
        }
    }
    const double huge[3] = {1.7e308, 1.7e308, 1.7e308};
    const double one[3] = {1.0, 1.0, 1.0};
    ck_assert_int_eq(pixel_of(healpix, huge), pixel_of(healpix, one));
    cm_healpix_destroy(healpix);
}
END_TEST

/* Any number of turns, and any finite longitude. */
START_TEST(longitudes)
{
    static const double far[] = {1e6, -1e10, 1e15, 1.2e15, -1e16, 1e22, 1e300, -1.7e308};
    uint64_t state = 6;
    cm_healpix *healpix = make_healpix(1024, CM_HEALPIX_RING, NULL);
    for (int i = 0; i < 20000; i++)
    {
        int64_t a = -7;
        int64_t b = -8;
        double theta = 0.5 * pi * (1.0 + next_real(&state));
        double lon = i < 8 ? far[i] : 1e9 * next_real(&state);
        const double d[3] = {sin(theta) * cos(lon), sin(theta) * sin(lon), cos(theta)};
        ck_assert_int_eq(cm_healpix_pixel_from_angles(healpix, theta, lon, &a), CM_OK);
        ck_assert_int_eq(cm_healpix_pixel_from_direction(healpix, d, &b), CM_OK);
        REQUIRE(a == b, "theta %.17g lon %.17g", theta, lon);
    }
    cm_healpix_destroy(healpix);
}
END_TEST

/* Near, far and no longitudes in one array. */
START_TEST(longitudes_of_all_kinds)
{
    static const double lon[] = {
        0.25,      1e300, (double)INFINITY,  -1e17, 3.0,     -7.5, (double)NAN,
        0x1p50,    1e6,   -(double)INFINITY, 4e15,  1.7e308, -0.0, 1e22,
        -0x1.8p50, 2.0,   -(double)INFINITY};
    enum
    {
        COUNT = sizeof lon / sizeof lon[0]
    };
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        cm_healpix *healpix = make_healpix(256, CM_HEALPIX_NESTED, cm_instructions_at(s));
        double lat[COUNT];
        int64_t made[COUNT];
        for (int i = 0; i < COUNT; i++)
        {
            lat[i] = 0.09 * (i - 8);
            made[i] = -7;
        }
        cm_healpix_pixel_from_lonlat_array(healpix, COUNT, lon, lat, made);
        for (int i = 0; i < COUNT; i++)
        {
            const double d[3] = {cos(lat[i]) * cos(lon[i]), cos(lat[i]) * sin(lon[i]), sin(lat[i])};
            const int64_t pixel = isfinite(lon[i]) ? pixel_of(healpix, d) : CM_HEALPIX_NO_PIXEL;
            REQUIRE(made[i] == pixel, "%s: longitude %g is in %lld, not %lld",
                    cm_instructions_at(s), lon[i], (long long)made[i], (long long)pixel);
        }
        cm_healpix_destroy(healpix);
    }
}
END_TEST

/* ---- Bad input ---- */

START_TEST(bad_points)
{
    static const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    cm_healpix *healpix = make_healpix(64, CM_HEALPIX_RING, NULL);
    const double zero[3] = {0.0, -0.0, 0.0};
    int64_t pixel = -7;
    ck_assert_int_eq(cm_healpix_pixel_from_direction(healpix, zero, &pixel), CM_ERROR_PIXEL);
    for (int i = 0; i < 3; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            double d[3] = {0.5, 0.25, 0.125};
            d[k] = bad[i];
            ck_assert_int_eq(cm_healpix_pixel_from_direction(healpix, d, &pixel), CM_ERROR_PIXEL);
        }
        ck_assert_int_eq(cm_healpix_pixel_from_angles(healpix, bad[i], 1.0, &pixel),
                         CM_ERROR_PIXEL);
        ck_assert_int_eq(cm_healpix_pixel_from_angles(healpix, 1.0, bad[i], &pixel),
                         CM_ERROR_PIXEL);
        ck_assert_int_eq(cm_healpix_pixel_from_lonlat(healpix, bad[i], 0.0, &pixel),
                         CM_ERROR_PIXEL);
        ck_assert_int_eq(cm_healpix_pixel_from_lonlat(healpix, 0.0, bad[i], &pixel),
                         CM_ERROR_PIXEL);
    }
    ck_assert_int_eq(cm_healpix_pixel_from_angles(healpix, -5e-324, 0.0, &pixel), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_pixel_from_angles(healpix, nextafter(pi, 4.0), 0.0, &pixel),
                     CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_pixel_from_lonlat(healpix, 0.0, nextafter(0.5 * pi, 4.0), &pixel),
                     CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_pixel_from_lonlat(healpix, 0.0, nextafter(-0.5 * pi, -4.0), &pixel),
                     CM_ERROR_PIXEL);
    ck_assert_int_eq(pixel, -7);
    cm_healpix_destroy(healpix);
}
END_TEST

static void check_bad_pixel(const cm_healpix *healpix, int64_t pixel)
{
    double d[3] = {7.0, 7.0, 7.0};
    double theta = 7.0;
    double phi = 7.0;
    int64_t numbers[8] = {-7, -7, -7, -7, -7, -7, -7, -7};
    int64_t made = -7;
    ck_assert_int_eq(cm_healpix_direction_from_pixel(healpix, pixel, d), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_angles_from_pixel(healpix, pixel, &theta, &phi), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_lonlat_from_pixel(healpix, pixel, d), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_nested_from_ring(healpix, pixel, &made), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_ring_from_nested(healpix, pixel, &made), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_neighbours(healpix, pixel, numbers), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_boundary(healpix, pixel, 1, d, d, d), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_ring_from_pixel(healpix, pixel, &made, &made), CM_ERROR_PIXEL);
    ck_assert(d[0] == 7.0 && d[1] == 7.0 && d[2] == 7.0 && theta == 7.0 && phi == 7.0);
    ck_assert(made == -7 && numbers[0] == -7 && numbers[7] == -7);
    cm_healpix_direction_from_pixel_array(healpix, 1, &pixel, &d[0], &d[1], &d[2]);
    cm_healpix_angles_from_pixel_array(healpix, 1, &pixel, &theta, &phi);
    ck_assert(isnan(d[0]) && isnan(d[1]) && isnan(d[2]) && isnan(theta) && isnan(phi));
    cm_healpix_lonlat_from_pixel_array(healpix, 1, &pixel, &d[0], &d[1]);
    ck_assert(isnan(d[0]) && isnan(d[1]));
    ck_assert_int_eq(cm_healpix_nested_from_ring_array(healpix, 1, &pixel, &made), CM_OK);
    ck_assert_int_eq(made, CM_HEALPIX_NO_PIXEL);
    made = -7;
    ck_assert_int_eq(cm_healpix_ring_from_nested_array(healpix, 1, &pixel, &made), CM_OK);
    ck_assert_int_eq(made, CM_HEALPIX_NO_PIXEL);
}

START_TEST(bad_pixels)
{
    static const int64_t nsides[] = {1, 64, CM_HEALPIX_NSIDE_MAX};
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        for (int i = 0; i < 6; i++)
        {
            cm_healpix *healpix =
                make_healpix(nsides[i / 2], (cm_healpix_order)(i % 2), cm_instructions_at(s));
            int64_t count = cm_healpix_pixel_count(healpix);
            const int64_t bad[] = {-1, -2, INT64_MIN, INT64_MAX, count, count + 1, count + 12345};
            for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
            {
                check_bad_pixel(healpix, bad[k]);
            }
            cm_healpix_destroy(healpix);
        }
    }
}
END_TEST

/* There is no NESTED where nside is no power of two. */
START_TEST(no_nested_numbers)
{
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        cm_healpix *healpix = make_healpix(3, CM_HEALPIX_RING, cm_instructions_at(s));
        int64_t made = -7;
        ck_assert_int_eq(cm_healpix_nested_from_ring(healpix, 5, &made), CM_ERROR_PIXEL);
        ck_assert_int_eq(cm_healpix_ring_from_nested(healpix, 5, &made), CM_ERROR_PIXEL);
        ck_assert_int_eq(made, -7);
        cm_healpix_destroy(healpix);
    }
}
END_TEST

/* ---- Arrays: as single points, to the bit, wherever a point stands ---- */

enum
{
    ARRAY_MAX = 40,
    OFFSETS = 3,
    ROOM = ARRAY_MAX + OFFSETS + 1
};

/* Some of the points and pixels are bad. */
static void fill_points(const cm_healpix *healpix, uint64_t *state, double point[3][ROOM],
                        int64_t pixel[ROOM])
{
    for (int i = 0; i < ROOM; i++)
    {
        uint64_t bits = next_bits(state);
        int64_t count = cm_healpix_pixel_count(healpix);
        for (int k = 0; k < 3; k++)
        {
            point[k][i] = bits % 17 == 0 ? (double)NAN : 1.6 * next_real(state);
        }
        pixel[i] = bits % 13 == 0 ? -(int64_t)(bits % 5) : (int64_t)(bits % (uint64_t)count);
    }
}

/* What the output is before, and beyond its end. */
#define GUARD 77

static void check_from_points(const cm_healpix *healpix, size_t n, size_t offset,
                              double point[3][ROOM])
{
    const double *x = &point[0][offset];
    const double *y = &point[1][offset];
    const double *z = &point[2][offset];
    int64_t made[3][ROOM];
    for (int k = 0; k < 3; k++)
    {
        for (int i = 0; i < ROOM; i++)
        {
            made[k][i] = GUARD;
        }
    }
    cm_healpix_pixel_from_direction_array(healpix, n, x, y, z, &made[0][offset]);
    cm_healpix_pixel_from_angles_array(healpix, n, x, y, &made[1][offset]);
    cm_healpix_pixel_from_lonlat_array(healpix, n, x, y, &made[2][offset]);
    for (size_t i = 0; i < n; i++)
    {
        const double d[3] = {x[i], y[i], z[i]};
        int64_t one[3] = {-1, -1, -1};
        (void)cm_healpix_pixel_from_direction(healpix, d, &one[0]);
        (void)cm_healpix_pixel_from_angles(healpix, x[i], y[i], &one[1]);
        (void)cm_healpix_pixel_from_lonlat(healpix, x[i], y[i], &one[2]);
        for (int k = 0; k < 3; k++)
        {
            REQUIRE(made[k][offset + i] == one[k], "%zu of %zu, function %d", i, n, k);
        }
    }
    for (int k = 0; k < 3; k++)
    {
        REQUIRE(made[k][offset + n] == GUARD && (offset == 0 || made[k][offset - 1] == GUARD),
                "function %d writes beyond its array", k);
    }
}

static int same(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

static void check_to_points(const cm_healpix *healpix, size_t n, size_t offset,
                            const int64_t pixel[ROOM])
{
    double made[7][ROOM];
    double *to[7];
    for (int k = 0; k < 7; k++)
    {
        for (int i = 0; i < ROOM; i++)
        {
            made[k][i] = GUARD;
        }
        to[k] = &made[k][offset];
    }
    const int64_t *from = &pixel[offset];
    cm_healpix_direction_from_pixel_array(healpix, n, from, to[0], to[1], to[2]);
    cm_healpix_angles_from_pixel_array(healpix, n, from, to[3], to[4]);
    cm_healpix_lonlat_from_pixel_array(healpix, n, from, to[5], to[6]);
    for (size_t i = 0; i < n; i++)
    {
        double one[7] = {(double)NAN, (double)NAN, (double)NAN, (double)NAN,
                         (double)NAN, (double)NAN, (double)NAN};
        (void)cm_healpix_direction_from_pixel(healpix, from[i], &one[0]);
        (void)cm_healpix_angles_from_pixel(healpix, from[i], &one[3], &one[4]);
        (void)cm_healpix_lonlat_from_pixel(healpix, from[i], &one[5]);
        for (int k = 0; k < 7; k++)
        {
            REQUIRE(same(to[k][i], one[k]), "%zu of %zu, number %d: %a, alone %a", i, n, k,
                    to[k][i], one[k]);
        }
    }
    for (int k = 0; k < 7; k++)
    {
        REQUIRE(made[k][offset + n] == GUARD && (offset == 0 || made[k][offset - 1] == GUARD),
                "number %d is written beyond its array", k);
    }
}

static void check_renumbering(const cm_healpix *healpix, size_t n, size_t offset,
                              const int64_t pixel[ROOM])
{
    int64_t in_place[2][ROOM];
    memcpy(in_place[0], pixel, sizeof in_place[0]);
    memcpy(in_place[1], pixel, sizeof in_place[1]);
    int64_t *nested = &in_place[0][offset];
    int64_t *ring = &in_place[1][offset];
    REQUIRE(cm_healpix_nested_from_ring_array(healpix, n, nested, nested) == CM_OK &&
                cm_healpix_ring_from_nested_array(healpix, n, ring, ring) == CM_OK,
            "renumbering");
    for (size_t i = 0; i < n; i++)
    {
        int64_t one[2] = {-1, -1};
        (void)cm_healpix_nested_from_ring(healpix, pixel[offset + i], &one[0]);
        (void)cm_healpix_ring_from_nested(healpix, pixel[offset + i], &one[1]);
        REQUIRE(nested[i] == one[0] && ring[i] == one[1], "%zu of %zu", i, n);
    }
    REQUIRE(nested[n] == pixel[offset + n] && ring[n] == pixel[offset + n], "beyond the end");
}

START_TEST(arrays_are_single_points)
{
    static const int64_t nsides[] = {1, 64, CM_HEALPIX_NSIDE_MAX};
    uint64_t state = 7;
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        for (int i = 0; i < 6; i++)
        {
            cm_healpix *healpix =
                make_healpix(nsides[i / 2], (cm_healpix_order)(i % 2), cm_instructions_at(s));
            for (size_t n = 0; n <= ARRAY_MAX; n++)
            {
                double point[3][ROOM];
                int64_t pixel[ROOM];
                fill_points(healpix, &state, point, pixel);
                check_from_points(healpix, n, n % (OFFSETS + 1), point);
                check_to_points(healpix, n, n % (OFFSETS + 1), pixel);
                check_renumbering(healpix, n, n % (OFFSETS + 1), pixel);
            }
            cm_healpix_destroy(healpix);
        }
    }
}
END_TEST

int main(void)
{
    const TTest *tests[] = {resolutions,
                            every_pixel_of_small_maps,
                            known_numbers,
                            hard_pixels_of_the_finest_map,
                            poles,
                            lengths_do_not_count,
                            longitudes,
                            longitudes_of_all_kinds,
                            bad_points,
                            bad_pixels,
                            no_nested_numbers,
                            arrays_are_single_points,
                            NULL};
    return run_suite("healpix", tests);
}
