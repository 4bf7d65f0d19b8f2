/* SPDX-License-Identifier: MIT
 *
 * What makes channels comparable: gradients, the census, normalization and equalization, against hand values and sums over
 * whole windows.
 */
#include <cubemap/compensate.h>

#include "tests/suite.h"

enum
{
    WIDTH = 23,
    HEIGHT = 17,
    PIXELS = WIDTH * HEIGHT
};

static void draw_rough(float *picture)
{
    for (size_t i = 0; i < PIXELS; i++)
    {
        picture[i] = (float)((i * 7919 + 13) % 257) * 0.25f - 20.0f;
    }
}

static void expect_near(const float *value, const double *right, size_t n, double within)
{
    for (size_t i = 0; i < n; i++)
    {
        ck_assert_msg(fabs((double)value[i] - right[i]) <= within, "%zu: %g, not %g", i,
                      (double)value[i], right[i]);
    }
}

START_TEST(gradients_by_hand)
{
    static const float picture[9] = {1, 2, 4, 3, 5, 1, 0, 2, 8};
    /* middle: across (4 - 1) + 2 (1 - 3) + (8 - 0) = 7, down (0 - 1) + 2 (2 - 2) + (8 - 4) = 3 */
    float gradient[9];
    ck_assert_int_eq(cm_channel_gradient(3, 3, picture, gradient), CM_OK);
    const double middle = sqrt(58.0) / 8.0;
    expect_near(gradient + 4, &middle, 1, 1e-6);
    /* upper left, its own row above and column before: across 3 (2 - 1) + (5 - 3) = 5, down 3 (3 - 1) + (5 - 2) = 9 */
    const double corner = sqrt(106.0) / 8.0;
    expect_near(gradient, &corner, 1, 1e-6);
    static float slope[PIXELS];
    static float found[PIXELS];
    for (size_t i = 0; i < PIXELS; i++)
    {
        slope[i] = (float)(3 * (i % WIDTH) + 4 * (i / WIDTH));
    }
    ck_assert_int_eq(cm_channel_gradient(WIDTH, HEIGHT, slope, found), CM_OK);
    for (size_t i = WIDTH + 1; i < PIXELS - WIDTH; i++)
    {
        const size_t column = i % WIDTH;
        ck_assert(column == 0 || column == WIDTH - 1 || fabsf(found[i] - 5.0f) < 1e-5f);
    }
}
END_TEST

START_TEST(census_by_hand)
{
    static const float picture[9] = {1, 2, 7, 3, 5, 5, 9, NAN, 4};
    uint8_t census[9];
    ck_assert_int_eq(cm_channel_census(3, 3, picture, census), CM_OK);
    ck_assert_uint_eq(census[4], 1 + 2 + 8 + 128); /* 1, 2, 3 and 4 are less than 5 */
    ck_assert_uint_eq(census[0], 0);
    /* beyond the border 2, 7, 7, then 2 before it and 7 behind; 5, 5 and 5 below */
    ck_assert_uint_eq(census[2], 1 + 8 + 32 + 64 + 128);
    ck_assert_uint_eq(census[7], 0); /* nothing is less than NaN */
}
END_TEST

START_TEST(census_knows_no_gain)
{
    static float picture[PIXELS], other[PIXELS];
    static uint8_t census[2][PIXELS];
    draw_rough(picture);
    for (size_t i = 0; i < PIXELS; i++)
    {
        other[i] = 8.0f * picture[i] + 32.0f;
    }
    ck_assert_int_eq(cm_channel_census(WIDTH, HEIGHT, picture, census[0]), CM_OK);
    ck_assert_int_eq(cm_channel_census(WIDTH, HEIGHT, other, census[1]), CM_OK);
    ck_assert_mem_eq(census[0], census[1], PIXELS);
}
END_TEST

START_TEST(ranges_by_hand)
{
    static const float picture[5] = {-2, 3, NAN, 0, INFINITY};
    static const double right[5] = {0.0, 10.0, 0.0, 4.0, 0.0};
    float to[5];
    ck_assert_int_eq(cm_channel_normalize(5, 1, picture, 10.0, to), CM_OK);
    expect_near(to, right, 2, 1e-6);
    expect_near(to + 3, right + 3, 1, 1e-6);
    ck_assert(isnan(to[2]) && isnan(to[4]));
    static const float flat[3] = {7, 7, 7};
    ck_assert_int_eq(cm_channel_normalize(3, 1, flat, 1.0, to), CM_OK);
    ck_assert(to[0] == 0.0f && to[1] == 0.0f && to[2] == 0.0f);
}
END_TEST

/* Eq. 8, from all the values of a window. */
static double score_of(const float *picture, size_t pixel, int radius)
{
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (int y = -radius; y <= radius; y++)
    {
        for (int x = -radius; x <= radius; x++)
        {
            const int column = (int)(pixel % WIDTH) + x, row = (int)(pixel / WIDTH) + y;
            if (column >= 0 && row >= 0 && column < WIDTH && row < HEIGHT &&
                isfinite(picture[row * WIDTH + column]))
            {
                const double v = (double)picture[row * WIDTH + column];
                sum += v;
                squares += v * v;
                count += 1.0;
            }
        }
    }
    const double mean = sum / count;
    return ((double)picture[pixel] - mean) / sqrt(squares / count - mean * mean);
}

START_TEST(windows_as_summed)
{
    static float picture[PIXELS], to[PIXELS];
    draw_rough(picture);
    picture[5 * WIDTH + 5] = NAN;
    const int radii[] = {1, 3, 30};
    for (size_t k = 0; k < 3; k++)
    {
        ck_assert_int_eq(
            cm_channel_normalize_locally(WIDTH, HEIGHT, picture, (uint32_t)radii[k], to), CM_OK);
        for (size_t i = 0; i < PIXELS; i++)
        {
            const double right = score_of(picture, i, radii[k]);
            ck_assert_msg(isnan(picture[i]) ? isnan(to[i]) : fabs((double)to[i] - right) < 1e-4,
                          "radius %d, %zu: %g, not %g", radii[k], i, (double)to[i], right);
        }
    }
    for (size_t i = 0; i < PIXELS; i++)
    {
        picture[i] = 0.1f;
    }
    picture[0] = 1e4f;
    ck_assert_int_eq(cm_channel_normalize_locally(WIDTH, HEIGHT, picture, 2, to), CM_OK);
    ck_assert(to[PIXELS - 1] == 0.0f); /* flat there */
}
END_TEST

START_TEST(equalized_by_hand)
{
    static const float picture[8] = {0, 0, 0, 1, 2, 2, 4, NAN};
    static const double right[7] = {3 / 7.0, 3 / 7.0, 3 / 7.0, 4 / 7.0, 6 / 7.0, 6 / 7.0, 1.0};
    float to[8];
    ck_assert_int_eq(cm_channel_equalize(8, 1, picture, 4, to), CM_OK);
    expect_near(to, right, 7, 1e-6);
    ck_assert(isnan(to[7]));
}
END_TEST

START_TEST(tiles_between_two_ends)
{
    static float picture[PIXELS], whole[PIXELS], tiled[PIXELS];
    draw_rough(picture);
    ck_assert_int_eq(cm_channel_equalize(WIDTH, HEIGHT, picture, 256, whole), CM_OK);
    ck_assert_int_eq(cm_channel_equalize_locally(WIDTH, HEIGHT, picture, 1, 1e6, tiled), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        ck_assert(fabsf(tiled[i] - whole[i]) < 1e-6f); /* one tile without a limit */
    }
    /* a limit of 1 leaves each bin the mean: values as they are. Here there is one value a bin, 256 in all */
    static float ramp[256], same[256];
    for (size_t i = 0; i < 256; i++)
    {
        ramp[i] = (float)(i < 250 ? i % 2 : i);
    }
    ramp[255] = 255.0f;
    ck_assert_int_eq(cm_channel_equalize_locally(16, 16, ramp, 1, 1.0, same), CM_OK);
    for (size_t i = 250; i < 256; i++)
    {
        ck_assert(fabsf(same[i] - ((float)i + 1.0f) / 256.0f) < 0.02f);
    }
    /* each tile has its own scale: of two flat halves with a slope each, both are spread */
    ck_assert_int_eq(cm_channel_equalize_locally(WIDTH, HEIGHT, picture, 3, 3.0, tiled), CM_OK);
    for (size_t i = 0; i < PIXELS; i++)
    {
        ck_assert(tiled[i] >= 0.0f && tiled[i] <= 1.0f + 1e-6f);
    }
}
END_TEST

/* Half of a picture of one value is not there. What is there is equalized as without it, not towards 0. */
START_TEST(tiles_of_nothing_do_not_count)
{
    enum
    {
        SIDE = 16
    };
    static float picture[SIDE * SIDE], to[SIDE * SIDE];
    for (int by_rows = 0; by_rows < 2; by_rows++)
    {
        for (size_t i = 0; i < SIDE * SIDE; i++)
        {
            const size_t at = by_rows ? i / SIDE : i % SIDE;
            picture[i] = at < SIDE / 2 ? NAN : 3.0f;
        }
        ck_assert_int_eq(cm_channel_equalize_locally(SIDE, SIDE, picture, 2, 1e6, to), CM_OK);
        for (size_t i = 0; i < SIDE * SIDE; i++)
        {
            ck_assert(isnan(picture[i]) ? isnan(to[i]) : to[i] == 1.0f);
        }
    }
}
END_TEST

START_TEST(bad_input_is_refused)
{
    float one = 1.0f, to = 5.0f;
    uint8_t census = 9;
    ck_assert_int_eq(cm_channel_gradient(0, 1, &one, &to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_channel_gradient(1, 1, NULL, &to), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_channel_gradient(1, 1, &one, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_channel_census(1, 0, &one, &census), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_channel_census(1, 1, &one, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_channel_normalize(1, 1, &one, 0.0, &to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_channel_normalize(1, 1, &one, (double)NAN, &to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_channel_normalize(1, 1, NULL, 1.0, &to), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_channel_normalize_locally(1, 1, &one, 0, &to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_channel_normalize_locally(1, 1, &one, 1001, &to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_channel_normalize_locally(1, 1, &one, 1, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_channel_equalize(1, 1, &one, 1, &to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_channel_equalize(1, 1, &one, 65537, &to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_channel_equalize(1, 1, NULL, 2, &to), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_channel_equalize_locally(1, 1, &one, 2, 2.0, &to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_channel_equalize_locally(1, 1, &one, 1, 0.5, &to), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_channel_equalize_locally(1, 1, &one, 1, 2.0, NULL), CM_ERROR_ARGUMENT);
    ck_assert(to == 5.0f && census == 9);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {gradients_by_hand,      census_by_hand,
                                  census_knows_no_gain,   ranges_by_hand,
                                  windows_as_summed,      equalized_by_hand,
                                  tiles_between_two_ends, tiles_of_nothing_do_not_count,
                                  bad_input_is_refused,   NULL};
    return run_suite("compensate channel", tests);
}
