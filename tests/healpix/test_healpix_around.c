/* SPDX-License-Identifier: MIT
 *
 * HEALPix: neighbours, boundaries and rings, against geometry: pixels that touch have corners in common.
 */
#include "healpix_suite.h"

enum
{
    PIXELS_MAX = 12 * 8 * 8
};

static double corners[PIXELS_MAX][4][3]; /* north, west, south, east */

static void fill_corners(const cm_healpix *healpix)
{
    for (int64_t pixel = 0; pixel < cm_healpix_pixel_count(healpix); pixel++)
    {
        double x[4];
        double y[4];
        double z[4];
        REQUIRE(cm_healpix_boundary(healpix, pixel, 1, x, y, z) == CM_OK, PIXEL_FORMAT,
                PIXEL_OF(healpix, pixel));
        for (int k = 0; k < 4; k++)
        {
            corners[pixel][k][0] = x[k];
            corners[pixel][k][1] = y[k];
            corners[pixel][k][2] = z[k];
        }
    }
}

static int has_corner(int64_t pixel, const double corner[3])
{
    for (int k = 0; k < 4; k++)
    {
        if (angle_between(corners[pixel][k], corner) < 1e-9)
        {
            return 1;
        }
    }
    return 0;
}

/* The corners that the neighbour in each of the eight directions shares: both of a side, or one. */
static void check_neighbours(const cm_healpix *healpix, int64_t pixel)
{
    enum
    {
        N,
        W,
        S,
        E
    };
    static const int shared[8][2] = {{S, W}, {W, W}, {W, N}, {N, N},
                                     {N, E}, {E, E}, {E, S}, {S, S}};
    int64_t neighbour[8];
    int count = 0;
    int touching = 0;
    REQUIRE(cm_healpix_neighbours(healpix, pixel, neighbour) == CM_OK, PIXEL_FORMAT,
            PIXEL_OF(healpix, pixel));
    for (int i = 0; i < 8; i++)
    {
        int64_t other = neighbour[i];
        if (other == CM_HEALPIX_NO_PIXEL)
        {
            REQUIRE(i % 2 == 1, PIXEL_FORMAT ": no neighbour at side %d", PIXEL_OF(healpix, pixel),
                    i);
            continue;
        }
        int64_t back[8];
        int is_mutual = 0;
        count++;
        REQUIRE(other >= 0 && other < cm_healpix_pixel_count(healpix) && other != pixel &&
                    has_corner(other, corners[pixel][shared[i][0]]) &&
                    has_corner(other, corners[pixel][shared[i][1]]),
                PIXEL_FORMAT ": neighbour %d is %lld", PIXEL_OF(healpix, pixel), i,
                (long long)other);
        REQUIRE(cm_healpix_neighbours(healpix, other, back) == CM_OK, "%lld", (long long)other);
        for (int k = 0; k < 8; k++)
        {
            is_mutual |= back[k] == pixel;
        }
        REQUIRE(is_mutual, PIXEL_FORMAT ": %lld is its neighbour, but not the other way",
                PIXEL_OF(healpix, pixel), (long long)other);
        for (int k = 0; k < i; k++)
        {
            REQUIRE(neighbour[k] != other || cm_healpix_nside(healpix) == 1,
                    PIXEL_FORMAT ": %lld twice", PIXEL_OF(healpix, pixel), (long long)other);
        }
    }
    for (int64_t other = 0; other < cm_healpix_pixel_count(healpix); other++)
    {
        touching += other != pixel &&
                    (has_corner(other, corners[pixel][N]) || has_corner(other, corners[pixel][W]) ||
                     has_corner(other, corners[pixel][S]) || has_corner(other, corners[pixel][E]));
    }
    REQUIRE(count == touching, PIXEL_FORMAT ": %d neighbours, %d pixels touch it",
            PIXEL_OF(healpix, pixel), count, touching);
}

START_TEST(neighbours_touch)
{
    for (int64_t nside = 1; nside <= 8; nside++)
    {
        for (int order = 0; order < 1 + is_power_of_two(nside); order++)
        {
            cm_healpix *healpix = make_healpix(nside, (cm_healpix_order)order, NULL);
            fill_corners(healpix);
            for (int64_t pixel = 0; pixel < cm_healpix_pixel_count(healpix); pixel++)
            {
                check_neighbours(healpix, pixel);
            }
            cm_healpix_destroy(healpix);
        }
    }
}
END_TEST

/* At the greatest nside: a step beyond each side's middle, or beyond a corner, is in the neighbour. */
START_TEST(neighbours_of_the_finest_map)
{
    const int64_t nside = CM_HEALPIX_NSIDE_MAX;
    uint64_t state = 3;
    for (int order = 0; order < 2; order++)
    {
        cm_healpix *healpix = make_healpix(nside, (cm_healpix_order)order, NULL);
        for (int i = 0; i < 20000; i++)
        {
            int64_t neighbour[8];
            double centre[3];
            double x[8];
            double y[8];
            double z[8];
            int64_t pixel = (int64_t)(next_bits(&state) % (uint64_t)(12 * nside * nside));
            centre_of(healpix, pixel, centre);
            REQUIRE(cm_healpix_neighbours(healpix, pixel, neighbour) == CM_OK &&
                        cm_healpix_boundary(healpix, pixel, 2, x, y, z) == CM_OK,
                    PIXEL_FORMAT, PIXEL_OF(healpix, pixel));
            for (int k = 0; k < 8; k++)
            {
                /* points go on from north by north-west, neighbours from south-west by west */
                int at = (11 - k) % 8;
                const double beyond[3] = {centre[0] + 1.2 * (x[at] - centre[0]),
                                          centre[1] + 1.2 * (y[at] - centre[1]),
                                          centre[2] + 1.2 * (z[at] - centre[2])};
                REQUIRE(pixel_of(healpix, beyond) == neighbour[k], PIXEL_FORMAT ": neighbour %d",
                        PIXEL_OF(healpix, pixel), k);
            }
        }
        cm_healpix_destroy(healpix);
    }
}
END_TEST

/* ---- Boundaries ---- */

enum
{
    STEPS = 5
};

/* Points a little inside the boundary are in the pixel, others a little outside in others; corners are those of
 * one step. */
static void check_boundary(const cm_healpix *healpix, int64_t pixel)
{
    double x[4 * STEPS];
    double y[4 * STEPS];
    double z[4 * STEPS];
    double corner[3][4];
    double centre[3];
    centre_of(healpix, pixel, centre);
    REQUIRE(cm_healpix_boundary(healpix, pixel, STEPS, x, y, z) == CM_OK &&
                cm_healpix_boundary(healpix, pixel, 1, corner[0], corner[1], corner[2]) == CM_OK,
            PIXEL_FORMAT, PIXEL_OF(healpix, pixel));
    for (int i = 0; i < 4 * STEPS; i++)
    {
        const double inside[3] = {x[i] + 1e-6 * (centre[0] - x[i]),
                                  y[i] + 1e-6 * (centre[1] - y[i]),
                                  z[i] + 1e-6 * (centre[2] - z[i])};
        const double beyond[3] = {x[i] - 1e-6 * (centre[0] - x[i]),
                                  y[i] - 1e-6 * (centre[1] - y[i]),
                                  z[i] - 1e-6 * (centre[2] - z[i])};
        REQUIRE(pixel_of(healpix, inside) == pixel && pixel_of(healpix, beyond) != pixel,
                PIXEL_FORMAT ": point %d", PIXEL_OF(healpix, pixel), i);
        REQUIRE(fabs(x[i] * x[i] + y[i] * y[i] + z[i] * z[i] - 1.0) < 1e-15, "%d", i);
    }
    for (int k = 0; k < 4; k++)
    {
        const double a[3] = {x[k * STEPS], y[k * STEPS], z[k * STEPS]};
        const double b[3] = {corner[0][k], corner[1][k], corner[2][k]};
        REQUIRE(angle_between(a, b) < 4e-16, PIXEL_FORMAT ": corner %d", PIXEL_OF(healpix, pixel),
                k);
    }
    REQUIRE(corner[2][0] > corner[2][1] && corner[2][1] > corner[2][2], "north, west, south");
}

static void check_boundaries(const cm_healpix *healpix)
{
    /* about base pixels' middles great circles leave a pixel whose sides are curved: not a small one */
    for (int64_t pixel = 0; pixel < cm_healpix_pixel_count(healpix); pixel++)
    {
        check_boundary(healpix, pixel);
    }
}

START_TEST(boundaries_are_between_pixels)
{
    for (int64_t nside = 2; nside <= 12; nside++)
    {
        cm_healpix *healpix = make_healpix(nside, CM_HEALPIX_RING, NULL);
        check_boundaries(healpix);
        cm_healpix_destroy(healpix);
    }
    cm_healpix *healpix = make_healpix(16, CM_HEALPIX_NESTED, NULL);
    check_boundaries(healpix);
    double x[4] = {7.0};
    ck_assert_int_eq(cm_healpix_boundary(healpix, 0, 0, x, x, x), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_healpix_boundary(healpix, 0, (1u << 20) + 1, x, x, x), CM_ERROR_ARGUMENT);
    ck_assert(x[0] == 7.0);
    cm_healpix_destroy(healpix);
}
END_TEST

/* ---- Rings ---- */

static void check_rings(const cm_healpix *healpix)
{
    int64_t first = 0;
    double above = 1.0;
    int is_ring_order = cm_healpix_order_of(healpix) == CM_HEALPIX_RING;
    for (int64_t ring = 1; ring <= cm_healpix_ring_count(healpix); ring++)
    {
        cm_healpix_ring info = {.size = sizeof info};
        REQUIRE(cm_healpix_ring_info(healpix, ring, &info) == CM_OK, "ring %lld", (long long)ring);
        REQUIRE(info.ring == ring && info.first == first && info.count > 0 && info.z < above &&
                    fabs(info.z * info.z + info.rho * info.rho - 1.0) < 1e-15,
                "nside %lld, ring %lld", (long long)cm_healpix_nside(healpix), (long long)ring);
        for (int64_t i = 0; i < info.count; i++)
        {
            int64_t pixel = first + i;
            int64_t found = -7;
            int64_t index = -7;
            double theta;
            double phi;
            double d[3];
            REQUIRE(is_ring_order ||
                        cm_healpix_nested_from_ring(healpix, first + i, &pixel) == CM_OK,
                    PIXEL_FORMAT, PIXEL_OF(healpix, first + i));
            REQUIRE(cm_healpix_ring_from_pixel(healpix, pixel, &found, &index) == CM_OK &&
                        found == ring && index == i,
                    PIXEL_FORMAT ": ring %lld, %lld", PIXEL_OF(healpix, pixel), (long long)found,
                    (long long)index);
            centre_of(healpix, pixel, d);
            REQUIRE(cm_healpix_angles_from_pixel(healpix, pixel, &theta, &phi) == CM_OK &&
                        fabs(phi - 6.283185307179586 * ((double)i + (info.is_shifted ? 0.5 : 0.0)) /
                                       (double)info.count) < 2e-15,
                    PIXEL_FORMAT, PIXEL_OF(healpix, pixel));
            REQUIRE(d[2] == info.z && fabs(hypot(d[0], d[1]) - info.rho) < 3e-16, PIXEL_FORMAT,
                    PIXEL_OF(healpix, pixel));
        }
        first += info.count;
        above = info.z;
    }
    REQUIRE(first == cm_healpix_pixel_count(healpix), "%lld pixels", (long long)first);
}

START_TEST(rings)
{
    for_small(check_rings);
    cm_healpix *healpix = make_healpix(16, CM_HEALPIX_RING, NULL);
    cm_healpix_ring info = {.size = sizeof info, .ring = -7};
    ck_assert_int_eq(cm_healpix_ring_info(healpix, 0, &info), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_ring_info(healpix, 64, &info), CM_ERROR_PIXEL);
    ck_assert_int_eq(cm_healpix_ring_info(healpix, 1, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(info.ring, -7);
    info.size--;
    ck_assert_int_eq(cm_healpix_ring_info(healpix, 1, &info), CM_ERROR_ARGUMENT);
    cm_healpix_destroy(healpix);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {neighbours_touch, neighbours_of_the_finest_map,
                            boundaries_are_between_pixels, rings, NULL};
    return run_suite("healpix around", tests);
}
