/* SPDX-License-Identifier: MIT
 *
 * HEALPix: a point alone has the pixel that it has in an array, near borders of pixels, too, where another way is taken
 * than elsewhere.
 */
#include "healpix_suite.h"

#include <inttypes.h>

enum
{
    POINTS = 512
};

/* From nothing to as much as a map has pixels: on borders, some ulp beside them, near them, anywhere. */
static double distance_from(uint64_t *state)
{
    const uint64_t bits = next_bits(state) >> 32;
    return bits % 8 == 0 ? 0.0 : next_real(state) * ldexp(1.0, -(int)(bits / 8 % 60));
}

/* Corners of pixels, which are where lines cross, points between two of them, and what is beside those. */
static void fill_directions(const cm_healpix *healpix, uint64_t *state, double point[3][POINTS])
{
    for (int i = 0; i < POINTS; i++)
    {
        double corner[3][4];
        const int64_t pixel =
            (int64_t)(next_bits(state) % (uint64_t)cm_healpix_pixel_count(healpix));
        ck_assert_int_eq(cm_healpix_boundary(healpix, pixel, 1, corner[0], corner[1], corner[2]),
                         CM_OK);
        const double along = next_bits(state) >> 63 != 0 ? 0.5 * (1.0 + next_real(state)) : 0.0;
        const double length = next_bits(state) >> 63 != 0 ? 1.0 : ldexp(1.5, (int)(i % 100) - 50);
        for (int k = 0; k < 3; k++)
        {
            const double at = corner[k][0] + along * (corner[k][1] - corner[k][0]);
            point[k][i] = length * (at + distance_from(state));
        }
    }
}

static void fill_angles(uint64_t *state, double point[3][POINTS], double latitude[POINTS])
{
    for (int i = 0; i < POINTS; i++)
    {
        const double d[3] = {point[0][i], point[1][i], point[2][i]};
        point[0][i] = atan2(hypot(d[0], d[1]), d[2]);
        latitude[i] = atan2(d[2], hypot(d[0], d[1]));
        point[1][i] = atan2(d[1], d[0]) + (double)(i % 5 - 2) * 6.283185307179586 +
                      distance_from(state) * 1e-6;
    }
}

static void check_directions(const cm_healpix *healpix, double point[3][POINTS])
{
    int64_t made[POINTS];
    cm_healpix_pixel_from_direction_array(healpix, POINTS, point[0], point[1], point[2], made);
    for (int i = 0; i < POINTS; i++)
    {
        const double d[3] = {point[0][i], point[1][i], point[2][i]};
        int64_t one = CM_HEALPIX_NO_PIXEL;
        (void)cm_healpix_pixel_from_direction(healpix, d, &one);
        REQUIRE(one == made[i], "%s, nside %" PRId64 ", %a %a %a: %" PRId64 ", alone %" PRId64,
                cm_healpix_instructions(healpix), cm_healpix_nside(healpix), d[0], d[1], d[2],
                made[i], one);
    }
}

static void check_angles(const cm_healpix *healpix, double point[3][POINTS],
                         const double latitude[POINTS])
{
    int64_t made[2][POINTS];
    cm_healpix_pixel_from_angles_array(healpix, POINTS, point[0], point[1], made[0]);
    cm_healpix_pixel_from_lonlat_array(healpix, POINTS, point[1], latitude, made[1]);
    for (int i = 0; i < POINTS; i++)
    {
        int64_t one[2] = {CM_HEALPIX_NO_PIXEL, CM_HEALPIX_NO_PIXEL};
        (void)cm_healpix_pixel_from_angles(healpix, point[0][i], point[1][i], &one[0]);
        (void)cm_healpix_pixel_from_lonlat(healpix, point[1][i], latitude[i], &one[1]);
        REQUIRE(one[0] == made[0][i] && one[1] == made[1][i],
                "%s, nside %" PRId64 ", theta %a, latitude %a, phi %a",
                cm_healpix_instructions(healpix), cm_healpix_nside(healpix), point[0][i],
                latitude[i], point[1][i]);
    }
}

START_TEST(points_near_borders)
{
    static const int64_t nsides[] = {1, 2, 3, 16, 1000, 65536, 1 << 25, CM_HEALPIX_NSIDE_MAX};
    uint64_t state = 11;
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        for (size_t i = 0; i < 2 * sizeof nsides / sizeof nsides[0]; i++)
        {
            const int64_t nside = nsides[i / 2];
            if (i % 2 == CM_HEALPIX_NESTED && (nside & (nside - 1)) != 0)
            {
                continue;
            }
            cm_healpix *healpix =
                make_healpix(nside, (cm_healpix_order)(i % 2), cm_instructions_at(s));
            for (int turn = 0; turn < 4; turn++)
            {
                double point[3][POINTS];
                double latitude[POINTS];
                fill_directions(healpix, &state, point);
                check_directions(healpix, point);
                fill_angles(&state, point, latitude);
                check_angles(healpix, point, latitude);
            }
            cm_healpix_destroy(healpix);
        }
    }
}
END_TEST

/* Lengths from the least to the greatest, and coordinates of which one is next to nothing. */
START_TEST(lengths_of_all_kinds)
{
    static const double tiny[] = {0.0, 5e-324, 1e-310, 1e-200, 1e-100, 0x1p-100, 1e-29, 1e-15};
    uint64_t state = 12;
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        cm_healpix *healpix = make_healpix(1024, CM_HEALPIX_NESTED, cm_instructions_at(s));
        double point[3][POINTS];
        for (int i = 0; i < POINTS; i++)
        {
            const double length = ldexp(1.0, (int)(next_bits(&state) % 2096) - 1073);
            const uint64_t bits = next_bits(&state) >> 32;
            for (uint64_t k = 0; k < 3; k++)
            {
                const int is_tiny = bits % 4 == k;
                point[k][i] = is_tiny ? copysign(tiny[bits / 4 % 8], next_real(&state))
                                      : length * next_real(&state);
            }
        }
        check_directions(healpix, point);
        cm_healpix_destroy(healpix);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {points_near_borders, lengths_of_all_kinds, NULL};
    return run_suite("healpix alone", tests);
}
