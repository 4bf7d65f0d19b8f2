/* SPDX-License-Identifier: MIT
 *
 * How far pictures are from each other: against closed forms, direct sums and slow formulas of the tests' own.
 */
#include <cubemap/compare.h>
#include <cubemap/threads.h>

#include "own_flip.h"
#include "tests/suite.h"

#define PI 3.14159265358979323846

#define NOT_A_NUMBER ((float)NAN)
#define INFINITE ((float)INFINITY)

/* ---------------------------------------------------------------- memory that cannot be had */

#ifdef WRAPS_ALLOCATION
void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);

static int left_to_give = -1; /* below 0: all */

static int is_exhausted(void)
{
    if (left_to_give == 0)
    {
        return 1;
    }
    left_to_give -= left_to_give > 0;
    return 0;
}

void *__wrap_malloc(size_t size)
{
    return is_exhausted() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    return is_exhausted() ? NULL : __real_calloc(count, size);
}
#endif

/* ---------------------------------------------------------------- pictures */

static cm_image image_of(void *data, cm_pixel_type type, size_t width, size_t height,
                         uint32_t channels)
{
    return (cm_image){.size = sizeof(cm_image),
                      .data = data,
                      .type = type,
                      .width = (uint32_t)width,
                      .height = (uint32_t)height,
                      .channels = channels};
}

static cm_image floats(float *data, size_t width, size_t height, uint32_t channels)
{
    return image_of(data, CM_PIXEL_FLOAT, width, height, channels);
}

static cm_compare_options standard(void)
{
    return (cm_compare_options){.size = sizeof(cm_compare_options)};
}

static cm_error_figures no_figures(void)
{
    return (cm_error_figures){.size = sizeof(cm_error_figures)};
}

static cm_map_figures no_map(void)
{
    return (cm_map_figures){.size = sizeof(cm_map_figures)};
}

/* The next of numbers from 0 to 1 that look random. */
static float next_number(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777215.0f;
}

/* Waves with some noise, from 0 to 1, and the same with other noise and a moved edge. */
static void make_pictures(size_t width, size_t height, size_t channels, float *one, float *other)
{
    uint32_t state = 7;
    for (size_t i = 0; i < width * height; i++)
    {
        const double x = (double)(i % width);
        const double y = (double)(i / width);
        for (size_t c = 0; c < channels; c++)
        {
            const double wave = 0.5 + 0.3 * sin(0.31 * x + 0.2 * (double)c) * cos(0.17 * y);
            const double step = x > 0.6 * (double)width ? 0.15 : 0.0;
            const double moved = x > 0.6 * (double)width + 2 ? 0.15 : 0.0;
            one[i * channels + c] =
                (float)(wave + step + 0.05 * ((double)next_number(&state) - 0.5));
            other[i * channels + c] =
                (float)(wave + moved + 0.05 * ((double)next_number(&state) - 0.5));
        }
    }
}

static float *room(size_t count)
{
    float *const made = malloc(count * sizeof *made);
    ck_assert_ptr_nonnull(made);
    return made;
}

static void expect_near(double value, double expected, double tolerance, const char *what)
{
    REQUIRE(fabs(value - expected) <= tolerance, "%s: %.17g, not %.17g", what, value, expected);
}

/* ---------------------------------------------------------------- errors */

START_TEST(a_constant_offset)
{
    enum
    {
        WIDTH = 1100,
        HEIGHT = 5,
        COUNT = WIDTH * HEIGHT * 3
    };
    static uint8_t one[COUNT], other[COUNT];
    for (size_t i = 0; i < COUNT; i++)
    {
        one[i] = (uint8_t)(i % 200);
        other[i] = (uint8_t)(one[i] + 51);
    }
    const cm_image a = image_of(one, CM_PIXEL_U8, WIDTH, HEIGHT, 3);
    const cm_image b = image_of(other, CM_PIXEL_U8, WIDTH, HEIGHT, 3);
    cm_error_figures found = no_figures();
    ck_assert_int_eq(cm_compare_errors(&a, &b, NULL, &found), CM_OK);
    expect_near(found.mse, 0.04, 1e-15, "mse");
    expect_near(found.rmse, 0.2, 1e-15, "rmse");
    expect_near(found.mean_absolute, 0.2, 1e-15, "mean_absolute");
    expect_near(found.mean_signed, 0.2, 1e-15, "mean_signed");
    expect_near(found.largest, 0.2, 1e-15, "largest");
    expect_near(found.psnr, -10.0 * log10(0.04), 1e-12, "psnr");
    ck_assert(found.peak == 1.0);
    ck_assert(found.pixels == WIDTH * HEIGHT && found.weight == WIDTH * HEIGHT);
    ck_assert_int_eq(cm_compare_errors(&b, &a, NULL, &found), CM_OK);
    expect_near(found.mean_signed, -0.2, 1e-15, "mean_signed");
    ck_assert_int_eq(cm_compare_errors(&a, &a, NULL, &found), CM_OK);
    ck_assert(found.mse == 0.0 && found.largest == 0.0 && isinf(found.psnr) && found.psnr > 0.0);
    ck_assert(found.largest_row == 0 && found.largest_column == 0 && found.largest_channel == 0);
}
END_TEST

START_TEST(a_single_pixel)
{
    enum
    {
        WIDTH = 1300,
        HEIGHT = 300,
        COUNT = WIDTH * HEIGHT * 2
    };
    float *const one = room(COUNT);
    float *const other = room(COUNT);
    for (size_t i = 0; i < COUNT; i++)
    {
        one[i] = other[i] = 0.25f;
    }
    other[2 * (217 * WIDTH + 1103) + 1] = -1.75f;
    const cm_image a = floats(one, WIDTH, HEIGHT, 2);
    const cm_image b = floats(other, WIDTH, HEIGHT, 2);
    cm_error_figures found = no_figures();
    ck_assert_int_eq(cm_compare_errors(&a, &b, NULL, &found), CM_OK);
    expect_near(found.mse * COUNT, 4.0, 1e-14, "mse");
    expect_near(found.mean_signed * COUNT, -2.0, 1e-14, "mean_signed");
    ck_assert(found.largest == 2.0 && found.largest_row == 217 && found.largest_column == 1103 &&
              found.largest_channel == 1);
    ck_assert(found.peak == 0.25);
    /* of two that are as large the first one */
    other[2 * (217 * WIDTH + 1102)] = 2.25f;
    ck_assert_int_eq(cm_compare_errors(&a, &b, NULL, &found), CM_OK);
    ck_assert(found.largest_column == 1102 && found.largest_channel == 0);
    cm_compare_options options = standard();
    options.peak = 3.0;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    expect_near(found.psnr, 10.0 * log10(9.0 * COUNT / 8.0), 1e-12, "psnr");
    options.border = 83; /* of 300 rows, row 217 is the first one of the border below */
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    ck_assert(found.mse == 0.0 && found.pixels == (WIDTH - 166) * (HEIGHT - 166));
    options.border = 82;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    ck_assert(found.largest_row == 217 && found.largest_column == 1102);
    free(one);
    free(other);
}
END_TEST

START_TEST(channels_alone)
{
    float one[4][3] = {{0, 0, 0}, {1, 2, 3}, {0, 0, 0}, {4, 4, 4}};
    float other[4][3] = {{0, 1, 0}, {1, 2, 5}, {0, 0, 0}, {4, 4, 1}};
    const cm_image a = floats(one[0], 2, 2, 3), b = floats(other[0], 2, 2, 3);
    cm_errors *errors = NULL;
    cm_error_figures found = no_figures();
    ck_assert_int_eq(cm_errors_create(3, NULL, &errors), CM_OK);
    ck_assert_int_eq(cm_errors_add(errors, &a, &b, NULL), CM_OK);
    const double mse[3] = {0.0, 0.25, 13.0 / 4.0};
    const double with_sign[3] = {0.0, 0.25, -0.25};
    for (uint32_t c = 0; c < 3; c++)
    {
        ck_assert_int_eq(cm_errors_get(errors, c, &found), CM_OK);
        ck_assert(found.mse == mse[c] && found.mean_signed == with_sign[c]);
        ck_assert(found.peak == 4.0);
    }
    ck_assert(found.largest_channel == 2 && found.largest_row == 1 && found.largest_column == 1);
    ck_assert_int_eq(cm_errors_get(errors, CM_ALL_CHANNELS, &found), CM_OK);
    expect_near(found.mse, 14.0 / 12.0, 1e-15, "mse");
    ck_assert_int_eq(cm_errors_get(errors, 3, &found), CM_ERROR_ARGUMENT);
    cm_errors_destroy(errors);
    cm_errors_destroy(NULL);
}
END_TEST

/* WS-PSNR, by a direct sum over weights of the paper, cos((j + 0.5 - N / 2) pi / N). */
START_TEST(errors_by_solid_angle)
{
    enum
    {
        WIDTH = 180,
        HEIGHT = 90
    };
    static float one[WIDTH * HEIGHT * 3], other[WIDTH * HEIGHT * 3], plane[WIDTH * HEIGHT];
    float rows[HEIGHT];
    make_pictures(WIDTH, HEIGHT, 3, one, other);
    ck_assert_int_eq(cm_equirect_weights(WIDTH, HEIGHT, rows), CM_OK);
    double sum = 0, weights = 0, angle = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++)
    {
        const double j = (double)(i / WIDTH);
        const double weight = cos((j + 0.5 - HEIGHT / 2.0) * PI / HEIGHT);
        for (size_t c = 0; c < 3; c++)
        {
            const double error = (double)other[3 * i + c] - (double)one[3 * i + c];
            sum += weight * error * error;
        }
        weights += 3 * weight;
        plane[i] = rows[i / WIDTH];
        angle += (double)plane[i];
    }
    expect_near(angle, 4.0 * PI, 1e-6, "solid angle");
    const cm_image a = floats(one, WIDTH, HEIGHT, 3), b = floats(other, WIDTH, HEIGHT, 3);
    const cm_image narrow = floats(rows, 1, HEIGHT, 1), wide = floats(plane, WIDTH, HEIGHT, 1);
    cm_compare_options options = standard();
    options.peak = 1.0;
    options.weights = &narrow;
    cm_error_figures found = no_figures(), again = no_figures();
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    expect_near(found.psnr, -10.0 * log10(sum / weights), 1e-6, "WS-PSNR");
    options.weights = &wide;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &again), CM_OK);
    ck_assert(memcmp(&found, &again, sizeof found) == 0);
    options.border = 3;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &again), CM_OK);
    options.weights = &narrow;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    ck_assert(memcmp(&found, &again, sizeof found) == 0 && found.pixels == 174 * 84);
}
END_TEST

/* The same bits from any blocks of rows, in any number of threads. */
START_TEST(blocks_and_threads_change_no_bit)
{
    enum
    {
        WIDTH = 1500,
        HEIGHT = 211
    };
    float *const one = room(WIDTH * HEIGHT * 3);
    float *const other = room(WIDTH * HEIGHT * 3);
    make_pictures(WIDTH, HEIGHT, 3, one, other);
    const cm_image a = floats(one, WIDTH, HEIGHT, 3), b = floats(other, WIDTH, HEIGHT, 3);
    static const uint32_t blocks[] = {1, 2, 7, 64, HEIGHT};
    cm_error_figures first = no_figures();
    cm_compare_options options = standard();
    options.threads = 1;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &first), CM_OK);
    for (size_t k = 0; k < sizeof blocks / sizeof *blocks; k++)
    {
        cm_errors *errors = NULL;
        cm_error_figures found = no_figures();
        options.threads = (unsigned)k;
        ck_assert_int_eq(cm_errors_create(3, &options, &errors), CM_OK);
        for (uint32_t row = 0; row < HEIGHT; row += blocks[k])
        {
            cm_image of_one = a, of_other = b;
            of_one.height = of_other.height = row + blocks[k] < HEIGHT ? blocks[k] : HEIGHT - row;
            of_one.data = one + (size_t)row * WIDTH * 3;
            of_other.data = other + (size_t)row * WIDTH * 3;
            ck_assert_int_eq(cm_errors_add(errors, &of_one, &of_other, NULL), CM_OK);
        }
        ck_assert_int_eq(cm_errors_get(errors, CM_ALL_CHANNELS, &found), CM_OK);
        REQUIRE(memcmp(&found, &first, sizeof found) == 0, "blocks of %u rows", blocks[k]);
        cm_errors_destroy(errors);
    }
    free(one);
    free(other);
}
END_TEST

START_TEST(every_type_of_pixel)
{
    uint8_t bytes[6] = {0, 51, 255, 102, 153, 204};
    uint16_t words[6] = {0, 13107, 65535, 26214, 39321, 52428};
    /* 0, 0.5, -2, the least one above 0, 65504, 1 / 3 */
    uint16_t halves[6] = {0x0000, 0x3800, 0xc000, 0x0001, 0x7bff, 0x3555};
    float of_halves[6] = {0.0f, 0.5f, -2.0f, 0x1p-24f, 65504.0f, 0.333251953125f};
    const cm_image byte = image_of(bytes, CM_PIXEL_U8, 3, 2, 1);
    const cm_image word = image_of(words, CM_PIXEL_U16, 3, 2, 1);
    const cm_image half = image_of(halves, CM_PIXEL_HALF, 3, 2, 1);
    const cm_image wide = floats(of_halves, 3, 2, 1);
    cm_error_figures found = no_figures();
    ck_assert_int_eq(cm_compare_errors(&byte, &word, NULL, &found), CM_OK);
    ck_assert(found.largest <= 0x1p-53 && found.peak == 1.0);
    ck_assert_int_eq(cm_compare_errors(&half, &wide, NULL, &found), CM_OK);
    ck_assert(found.largest == 0.0 && found.peak == 65504.0);
    /* upside down, from right to left */
    cm_image turned = byte;
    uint8_t opposite[6] = {204, 153, 102, 255, 51, 0};
    turned.data = opposite + 5;
    turned.row_stride = -3;
    turned.pixel_stride = -1;
    ck_assert_int_eq(cm_compare_errors(&byte, &turned, NULL, &found), CM_OK);
    ck_assert(found.largest == 0.0);
}
END_TEST

START_TEST(what_is_not_finite)
{
    float one[6] = {1, 2, NOT_A_NUMBER, INFINITE, 5, 6};
    float other[6] = {1, 3, NOT_A_NUMBER, INFINITE, 5, 6};
    float weight[6] = {1, 1, 0, 0, 1, 1};
    const cm_image a = floats(one, 3, 2, 1), b = floats(other, 3, 2, 1);
    const cm_image weights = floats(weight, 3, 2, 1);
    cm_compare_options options = standard();
    cm_error_figures found = no_figures();
    found.mse = 77.0;
    ck_assert_int_eq(cm_compare_errors(&a, &b, NULL, &found), CM_ERROR_RANGE);
    ck_assert(found.mse == 77.0);
    options.weights = &weights;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    ck_assert(found.mse == 0.25 && found.not_finite == 0 && found.pixels == 4);
    options.weights = NULL;
    options.not_finite = CM_COMPARE_SKIP;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    ck_assert(found.mse == 0.25 && found.not_finite == 2 && found.pixels == 4);
    options.not_finite = CM_COMPARE_ALIKE;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    ck_assert(found.mse == 1.0 / 6.0 && found.not_finite == 2 && found.pixels == 6);
    ck_assert(found.peak == 6.0);
    other[3] = -INFINITE;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    ck_assert(isinf(found.mse) && isinf(found.mean_absolute) && isinf(found.largest));
    ck_assert(isnan(found.mean_signed) && found.psnr < 0.0 && isinf(found.psnr));
    ck_assert(found.largest_row == 1 && found.largest_column == 0);
    /* nothing counts */
    float nothing[6] = {0};
    const cm_image none = floats(nothing, 3, 2, 1);
    options.weights = &none;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    ck_assert(isnan(found.mse) && isnan(found.largest) && isnan(found.psnr) && found.pixels == 0);
    options.weights = NULL;
    options.border = 2000000000;
    ck_assert_int_eq(cm_compare_errors(&a, &b, &options, &found), CM_OK);
    ck_assert(isnan(found.mse) && found.pixels == 0);
}
END_TEST

/* A refused block leaves what was there. */
START_TEST(refused_rows_are_not_added)
{
    float one[2] = {1, 2}, other[2] = {2, 2}, bad[2] = {9, NOT_A_NUMBER};
    const cm_image a = floats(one, 2, 1, 1), b = floats(other, 2, 1, 1), c = floats(bad, 2, 1, 1);
    cm_errors *errors = NULL;
    cm_error_figures before = no_figures(), after = no_figures();
    ck_assert_int_eq(cm_errors_create(1, NULL, &errors), CM_OK);
    ck_assert_int_eq(cm_errors_add(errors, &a, &b, NULL), CM_OK);
    ck_assert_int_eq(cm_errors_get(errors, 0, &before), CM_OK);
    ck_assert_int_eq(cm_errors_add(errors, &a, &c, NULL), CM_ERROR_RANGE);
    ck_assert_int_eq(cm_errors_get(errors, 0, &after), CM_OK);
    ck_assert(memcmp(&before, &after, sizeof before) == 0 && before.mse == 0.5);
    cm_errors_destroy(errors);
}
END_TEST

START_TEST(values_at_points)
{
    enum
    {
        COUNT = 5000
    };
    static float one[2 * COUNT], other[2 * COUNT];
    double sum = 0;
    make_pictures(COUNT, 1, 2, one, other);
    for (size_t i = 0; i < 2 * COUNT; i++)
    {
        sum += ((double)other[i] - (double)one[i]) * ((double)other[i] - (double)one[i]);
    }
    cm_error_figures found = no_figures();
    cm_compare_options options = standard();
    options.peak = 1.0;
    ck_assert_int_eq(cm_compare_values(COUNT, 2, one, other, &options, &found), CM_OK);
    expect_near(found.mse, sum / (2 * COUNT), 1e-16, "mse");
    ck_assert_int_eq(cm_compare_values(0, 2, one, other, &options, &found), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_compare_values(1, 2, NULL, other, NULL, &found), CM_ERROR_ARGUMENT);
}
END_TEST

/* ---------------------------------------------------------------- SSIM */

/* Of one place and channel, in two dimensions and with what is left of a window at the edge. */
static double slow_ssim(const float *one, const float *other, long width, long height,
                        size_t channels, size_t c, long column, long row, double peak)
{
    double weights = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for (int pass = 0; pass < 2; pass++) /* means, then variances about them */
    {
        for (long y = row - 5; y <= row + 5; y++)
        {
            for (long x = column - 5; x <= column + 5; x++)
            {
                const double far = (double)((x - column) * (x - column) + (y - row) * (y - row));
                const double weight = exp(-far / (2 * 1.5 * 1.5));
                if (x < 0 || y < 0 || x >= width || y >= height)
                {
                    continue;
                }
                const size_t at = (size_t)(y * width + x) * channels + c;
                const double p = (double)one[at], q = (double)other[at];
                weights += pass == 0 ? weight : 0;
                a += pass == 0 ? weight * p : 0;
                b += pass == 0 ? weight * q : 0;
                aa += pass == 1 ? weight / weights * (p - a) * (p - a) : 0;
                bb += pass == 1 ? weight / weights * (q - b) * (q - b) : 0;
                ab += pass == 1 ? weight / weights * (p - a) * (q - b) : 0;
            }
        }
        a = pass == 0 ? a / weights : a;
        b = pass == 0 ? b / weights : b;
    }
    const double c1 = 0.0001 * peak * peak, c2 = 0.0009 * peak * peak;
    return (2 * a * b + c1) * (2 * ab + c2) / ((a * a + b * b + c1) * (aa + bb + c2));
}

START_TEST(ssim_is_that_of_the_formula)
{
    enum
    {
        WIDTH = 83,
        HEIGHT = 71
    };
    static float one[WIDTH * HEIGHT * 3], other[WIDTH * HEIGHT * 3], map[WIDTH * HEIGHT];
    make_pictures(WIDTH, HEIGHT, 3, one, other);
    const cm_image a = floats(one, WIDTH, HEIGHT, 3), b = floats(other, WIDTH, HEIGHT, 3);
    const cm_image to = floats(map, WIDTH, HEIGHT, 1);
    cm_compare_options options = standard();
    cm_map_figures found = no_map();
    double means[3], sums[3] = {0, 0, 0}, lowest = 2;
    options.peak = 1.0;
    options.border = 5;
    ck_assert_int_eq(cm_ssim(&a, &b, &options, &found, &to, means), CM_OK);
    for (long i = 0; i < WIDTH * HEIGHT; i++)
    {
        const long x = i % WIDTH, y = i / WIDTH;
        double here = 0;
        for (size_t c = 0; c < 3; c++)
        {
            const double value = slow_ssim(one, other, WIDTH, HEIGHT, 3, c, x, y, 1.0);
            sums[c] += x < 5 || y < 5 || x >= WIDTH - 5 || y >= HEIGHT - 5 ? 0 : value;
            here += value / 3;
        }
        if (x < 5 || y < 5 || x >= WIDTH - 5 || y >= HEIGHT - 5)
        {
            ck_assert(isnan(map[i]));
            continue;
        }
        expect_near((double)map[i], here, 1e-7, "SSIM");
        lowest = here < lowest ? here : lowest;
    }
    for (size_t c = 0; c < 3; c++)
    {
        expect_near(means[c], sums[c] / ((WIDTH - 10) * (HEIGHT - 10)), 1e-12, "mean of a channel");
    }
    expect_near(found.mean, (means[0] + means[1] + means[2]) / 3, 1e-14, "mean");
    expect_near(found.lowest, lowest, 1e-12, "lowest");
    ck_assert(map[found.lowest_row * WIDTH + found.lowest_column] == (float)found.lowest);
    /* with windows that are cut */
    ck_assert_int_eq(cm_ssim(&a, &b, NULL, NULL, &to, NULL), CM_OK);
    double peak = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT * 3; i++)
    {
        peak = (double)one[i] > peak ? (double)one[i] : peak;
    }
    static const long places[][2] = {{0, 0},  {82, 0},  {0, 70}, {82, 70},
                                     {3, 40}, {63, 64}, {64, 2}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
    {
        double here = 0;
        for (size_t c = 0; c < 3; c++)
        {
            here +=
                slow_ssim(one, other, WIDTH, HEIGHT, 3, c, places[i][0], places[i][1], peak) / 3;
        }
        expect_near((double)map[places[i][1] * WIDTH + places[i][0]], here, 1e-7, "cut window");
    }
}
END_TEST

START_TEST(ssim_has_limits)
{
    enum
    {
        WIDTH = 70,
        HEIGHT = 20
    };
    static float one[WIDTH * HEIGHT], other[WIDTH * HEIGHT];
    make_pictures(WIDTH, HEIGHT, 1, one, other);
    const cm_image a = floats(one, WIDTH, HEIGHT, 1), b = floats(other, WIDTH, HEIGHT, 1);
    cm_map_figures found = no_map(), back = no_map();
    ck_assert_int_eq(cm_ssim(&a, &a, NULL, &found, NULL, NULL), CM_OK);
    ck_assert(found.mean == 1.0 && found.lowest == 1.0 && found.highest == 1.0);
    cm_compare_options options = standard();
    options.peak = 1.0;
    ck_assert_int_eq(cm_ssim(&a, &b, &options, &found, NULL, NULL), CM_OK);
    ck_assert_int_eq(cm_ssim(&b, &a, &options, &back, NULL, NULL), CM_OK);
    expect_near(back.mean, found.mean, 1e-15, "the other way round");
    ck_assert(found.mean < 1.0 && found.mean > 0.0);
    options.peak = 1e-40; /* far below the values: variances are what rounding leaves of them */
    ck_assert_int_eq(cm_ssim(&a, &b, &options, &found, NULL, NULL), CM_OK);
    ck_assert(found.lowest >= -1.0 && found.highest <= 1.0);
    float flat_one[400], flat_other[400];
    for (size_t i = 0; i < 400; i++)
    {
        flat_one[i] = 0.3f;
        flat_other[i] = 0.7f;
    }
    const cm_image c = floats(flat_one, 20, 20, 1), d = floats(flat_other, 20, 20, 1);
    ck_assert_int_eq(cm_ssim(&c, &d, &options, &found, NULL, NULL), CM_OK);
    ck_assert(found.lowest >= -1.0 && found.highest <= 1.0);
    options.peak = 1.0;
    /* constant ones: (2 p q + c1) / (p^2 + q^2 + c1) */
    float bright = 0.75f, dark = 0.25f;
    const cm_image p = floats(&bright, 1, 1, 1), q = floats(&dark, 1, 1, 1);
    ck_assert_int_eq(cm_ssim(&p, &q, &options, &found, NULL, NULL), CM_OK);
    expect_near(found.mean, 0.3751 / 0.6251, 1e-15, "constant");
}
END_TEST

/* ---------------------------------------------------------------- FLIP */

static double linear_of(double srgb)
{
    return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4);
}

START_TEST(flip_is_that_of_the_formulas)
{
    enum
    {
        WIDTH = 75,
        HEIGHT = 22,
        COUNT = WIDTH * HEIGHT
    };
    static const double densities[] = {67.02064327658226, 0.8, 2.0, 13.0, 100.0};
    static float one[COUNT * 3], other[COUNT * 3], map[COUNT];
    static double of_one[COUNT * 3], of_other[COUNT * 3], expected[COUNT];
    make_pictures(WIDTH, HEIGHT, 3, one, other);
    for (size_t i = 0; i < COUNT * 3;
         i += 7) /* colours that differ much, and reach the cube's walls */
    {
        other[i] = i % 2 == 0 ? 0.0f : 1.0f;
    }
    for (size_t k = 0; k < sizeof densities / sizeof *densities; k += step_of(2))
    {
        const cm_image a = floats(one, WIDTH, HEIGHT, 3), b = floats(other, WIDTH, HEIGHT, 3);
        const cm_image to = floats(map, WIDTH, HEIGHT, 1);
        cm_compare_options options = standard();
        cm_map_figures found = no_map();
        double sum = 0;
        options.pixels_per_degree = densities[k];
        options.linear = k % 2 == 1;
        for (size_t i = 0; i < COUNT * 3; i++)
        {
            of_one[i] = options.linear ? (double)one[i] : linear_of((double)one[i]);
            of_other[i] = options.linear ? (double)other[i] : linear_of((double)other[i]);
        }
        own_flip(WIDTH, HEIGHT, of_one, of_other, densities[k], expected);
        ck_assert_int_eq(cm_flip(&a, &b, &options, &found, &to), CM_OK);
        for (size_t i = 0; i < COUNT; i++)
        {
            REQUIRE(fabs((double)map[i] - expected[i]) <= 1e-6,
                    "density %g, pixel %zu: %.9g, not %.9g", densities[k], i, (double)map[i],
                    expected[i]);
            sum += expected[i];
        }
        expect_near(found.mean, sum / COUNT, 1e-9, "mean of FLIP");
        ck_assert(found.pixels == COUNT && found.exposure_count == 0);
    }
}
END_TEST

/* Figures of the authors' program: github.com/NVlabs/flip, python/flip_api.py at commit 313517b, its steps
 * and constants in NumPy's double precision, cv.filter2D as scipy.ndimage.correlate(mode="nearest"). It gives inverse
 * matrices to nine decimals. Of HDR its compute_exposure_params, and one exposure for each begun power of two. */
START_TEST(flip_is_that_of_the_authors)
{
    enum
    {
        WIDTH = 61,
        HEIGHT = 41,
        COUNT = WIDTH * HEIGHT
    };
    static const struct
    {
        double density; /* 0: HDR */
        double mean, first, middle;
    } cases[] = {{CM_FLIP_PIXELS_PER_DEGREE, 0.128503469, 0.008731963, 0.063693070},
                 {20.0, 0.118392204, 0.000133742, 0.017880096},
                 {0.0, 0.128788478, 0.032493491, 0.069391119}};
    static uint8_t one[COUNT * 3], other[COUNT * 3];
    static float bright_one[COUNT * 3], bright_other[COUNT * 3], map[COUNT];
    for (int i = 0; i < COUNT * 3; i++)
    {
        const int x = i / 3 % WIDTH, y = i / 3 / WIDTH;
        const int sum = x * x + 3 * y * y + 50 * (i % 3) + x * y;
        one[i] = (uint8_t)(sum / 7 % 256);
        other[i] = (uint8_t)((sum + x % 5 * (y % 3) * 9) / 7 % 256);
        bright_one[i] = (float)(one[i] * one[i]) / 4096.0f;
        bright_other[i] = (float)(other[i] * other[i]) / 4096.0f;
    }
    const cm_image a = image_of(one, CM_PIXEL_U8, WIDTH, HEIGHT, 3);
    const cm_image b = image_of(other, CM_PIXEL_U8, WIDTH, HEIGHT, 3);
    const cm_image c = floats(bright_one, WIDTH, HEIGHT, 3);
    const cm_image d = floats(bright_other, WIDTH, HEIGHT, 3);
    const cm_image to = floats(map, WIDTH, HEIGHT, 1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
        cm_compare_options options = standard();
        cm_map_figures found = no_map();
        options.pixels_per_degree = cases[i].density;
        ck_assert_int_eq(cases[i].density > 0.0 ? cm_flip(&a, &b, &options, &found, &to)
                                                : cm_flip_hdr(&c, &d, &options, &found, &to),
                         CM_OK);
        expect_near(found.mean, cases[i].mean, 1e-6, "the authors' mean");
        expect_near((double)map[0], cases[i].first, 1e-6, "the authors' first pixel");
        expect_near((double)map[20 * WIDTH + 30], cases[i].middle, 1e-6, "the authors' pixel");
        if (!(cases[i].density > 0.0))
        {
            expect_near(found.exposure_start, -2.8139458095281955, 1e-6, "first exposure");
            expect_near(found.exposure_stop, -0.6837548218772439, 1e-6, "last exposure");
            ck_assert_uint_eq(found.exposure_count, 3);
        }
    }
}
END_TEST

/* Black and white have no features, and CIELAB of L = 100 and 0. The farthest colours are sRGB's green and blue:
 * CIELAB 87.73, -86.18, 83.18 and 32.30, 79.19, -107.86. */
START_TEST(flip_of_constant_pictures)
{
    uint8_t black[25] = {0}, white[25];
    memset(white, 255, sizeof white);
    const cm_image a = image_of(black, CM_PIXEL_U8, 5, 5, 1);
    const cm_image b = image_of(white, CM_PIXEL_U8, 5, 5, 1);
    cm_map_figures found = no_map();
    ck_assert_int_eq(cm_flip(&a, &b, NULL, &found, NULL), CM_OK);
    const double most = pow(
        87.73 - 32.30 + hypot(0.8773 * 86.18 + 0.3230 * 79.19, 0.8773 * 83.18 + 0.3230 * 107.86),
        0.7);
    const double expected = 0.95 + 0.05 * (pow(100.0, 0.7) - 0.4 * most) / (0.6 * most);
    expect_near(found.mean, expected, 2e-5, "black and white");
    expect_near(found.lowest, found.highest, 1e-12, "constant");
    ck_assert_int_eq(cm_flip(&a, &a, NULL, &found, NULL), CM_OK);
    ck_assert(found.mean == 0.0 && found.highest == 0.0);
    uint8_t green[3] = {0, 255, 0}, blue[3] = {0, 0, 255};
    const cm_image c = image_of(green, CM_PIXEL_U8, 1, 1, 3);
    const cm_image d = image_of(blue, CM_PIXEL_U8, 1, 1, 3);
    ck_assert_int_eq(cm_flip(&c, &d, NULL, &found, NULL), CM_OK);
    expect_near(found.mean, 1.0, 1e-9, "green and blue");
}
END_TEST

START_TEST(flip_is_symmetric)
{
    enum
    {
        WIDTH = 130,
        HEIGHT = 70,
        COUNT = WIDTH * HEIGHT
    };
    static float one[COUNT * 3], other[COUNT * 3];
    static uint8_t byte_one[COUNT * 3], byte_other[COUNT * 3];
    make_pictures(WIDTH, HEIGHT, 3, one, other);
    for (size_t i = 0; i < COUNT * 3; i++)
    {
        byte_one[i] = (uint8_t)(one[i] * 255.0f + 0.5f);
        byte_other[i] = (uint8_t)(other[i] * 255.0f + 0.5f);
        one[i] = (float)byte_one[i] / 255.0f;
        other[i] = (float)byte_other[i] / 255.0f;
    }
    const cm_image a = floats(one, WIDTH, HEIGHT, 3), b = floats(other, WIDTH, HEIGHT, 3);
    const cm_image c = image_of(byte_one, CM_PIXEL_U8, WIDTH, HEIGHT, 3);
    const cm_image d = image_of(byte_other, CM_PIXEL_U8, WIDTH, HEIGHT, 3);
    cm_map_figures found = no_map(), back = no_map(), bytes = no_map();
    ck_assert_int_eq(cm_flip(&a, &b, NULL, &found, NULL), CM_OK);
    ck_assert_int_eq(cm_flip(&b, &a, NULL, &back, NULL), CM_OK);
    ck_assert_int_eq(cm_flip(&c, &d, NULL, &bytes, NULL), CM_OK);
    ck_assert(memcmp(&found, &back, sizeof found) == 0);
    expect_near(bytes.mean, found.mean, 1e-7, "whole numbers");
    ck_assert(found.mean > 0.0 && found.highest < 1.0);
}
END_TEST

/* HDR-FLIP is the greatest FLIP over exposures, each by the tests' own formulas. */
START_TEST(flip_of_high_dynamic_range)
{
    enum
    {
        WIDTH = 26,
        HEIGHT = 12,
        COUNT = WIDTH * HEIGHT
    };
    static float one[COUNT * 3], other[COUNT * 3], map[COUNT];
    static double of_one[COUNT * 3], of_other[COUNT * 3], here[COUNT], most[COUNT];
    static double luminance[COUNT];
    make_pictures(WIDTH, HEIGHT, 3, one, other);
    for (size_t i = 0; i < COUNT * 3; i++)
    {
        one[i] *= expf((float)(i % 41) * 0.2f);
        other[i] *= expf((float)(i % 41) * 0.2f);
    }
    other[5] = -4.0f;
    double greatest = 0;
    for (size_t i = 0; i < COUNT; i++)
    {
        luminance[i] = 0.2126 * (double)one[3 * i] + 0.7152 * (double)one[3 * i + 1] +
                       0.0722 * (double)one[3 * i + 2];
        greatest = luminance[i] > greatest ? luminance[i] : greatest;
    }
    for (size_t i = 1; i < COUNT; i++) /* sorted by insertion */
    {
        for (size_t j = i; j > 0 && luminance[j] < luminance[j - 1]; j--)
        {
            const double swapped = luminance[j];
            luminance[j] = luminance[j - 1];
            luminance[j - 1] = swapped;
        }
    }
    const double median = 0.5 * (luminance[COUNT / 2 - 1] + luminance[COUNT / 2]);
    const cm_image a = floats(one, WIDTH, HEIGHT, 3), b = floats(other, WIDTH, HEIGHT, 3);
    const cm_image to = floats(map, WIDTH, HEIGHT, 1);
    cm_map_figures found = no_map();
    cm_compare_options options = standard();
    options.pixels_per_degree = 20.0;
    ck_assert_int_eq(cm_flip_hdr(&a, &b, &options, &found, &to), CM_OK);
    expect_near(own_tone(greatest, found.exposure_start), 0.85, 1e-6, "the first exposure");
    expect_near(own_tone(median, found.exposure_stop), 0.85, 1e-6, "the last exposure");
    ck_assert(found.exposure_count == ceil(found.exposure_stop - found.exposure_start));
    for (uint32_t e = 0; e < found.exposure_count; e++)
    {
        const double exposure =
            found.exposure_start +
            e * (found.exposure_stop - found.exposure_start) / (found.exposure_count - 1);
        for (size_t i = 0; i < COUNT * 3; i++)
        {
            of_one[i] = own_tone((double)one[i], exposure);
            of_other[i] = own_tone((double)other[i], exposure);
        }
        own_flip(WIDTH, HEIGHT, of_one, of_other, 20.0, here);
        for (size_t i = 0; i < COUNT; i++)
        {
            most[i] = e == 0 || here[i] > most[i] ? here[i] : most[i];
        }
    }
    for (size_t i = 0; i < COUNT; i++)
    {
        expect_near((double)map[i], most[i], 1e-6, "HDR-FLIP");
    }
    options.exposure_start = options.exposure_stop = -1.5;
    options.exposure_count = 1;
    ck_assert_int_eq(cm_flip_hdr(&a, &b, &options, &found, &to), CM_OK);
    ck_assert(found.exposure_start == -1.5 && found.exposure_count == 1);
}
END_TEST

START_TEST(exposures_of_dark_pictures)
{
    float black[4] = {0}, some[4] = {0, 0, 0, 8}, odd[3] = {1, 4, 2};
    const cm_image a = floats(black, 4, 1, 1), b = floats(some, 4, 1, 1), c = floats(odd, 3, 1, 1);
    cm_map_figures found = no_map();
    ck_assert_int_eq(cm_flip_hdr(&a, &b, NULL, &found, NULL), CM_OK);
    ck_assert(found.exposure_start == 0.0 && found.exposure_stop == 0.0 &&
              found.exposure_count == 1 && found.mean > 0.0);
    ck_assert_int_eq(cm_flip_hdr(&b, &a, NULL, &found, NULL), CM_OK);
    ck_assert(found.exposure_start == found.exposure_stop && found.exposure_count == 2);
    expect_near(own_tone(8.0, found.exposure_start), 0.85, 1e-12, "the exposure");
    ck_assert_int_eq(cm_flip_hdr(&c, &c, NULL, &found, NULL), CM_OK);
    expect_near(own_tone(2.0, found.exposure_stop), 0.85, 1e-12, "the median of three");
    ck_assert(found.mean == 0.0);
}
END_TEST

/* ---------------------------------------------------------------- both */

typedef cm_status (*windowed)(const cm_image *, const cm_image *, const cm_compare_options *,
                              cm_map_figures *, const cm_image *);

static cm_status ssim(const cm_image *reference, const cm_image *picture,
                      const cm_compare_options *options, cm_map_figures *figures,
                      const cm_image *map)
{
    return cm_ssim(reference, picture, options, figures, map, NULL);
}

static const windowed measures[] = {ssim, cm_flip, cm_flip_hdr};

enum
{
    MEASURES = 3
};

/* The same bits from any number of threads, and weighted means of what is in the map. */
START_TEST(maps_have_weighted_means)
{
    enum
    {
        WIDTH = 150,
        HEIGHT = 75,
        COUNT = WIDTH * HEIGHT
    };
    static float one[COUNT * 3], other[COUNT * 3], rows[HEIGHT], map[COUNT], again[COUNT];
    make_pictures(WIDTH, HEIGHT, 3, one, other);
    ck_assert_int_eq(cm_equirect_weights(WIDTH, HEIGHT, rows), CM_OK);
    rows[20] = 0.0f;
    const cm_image a = floats(one, WIDTH, HEIGHT, 3), b = floats(other, WIDTH, HEIGHT, 3);
    const cm_image weights = floats(rows, 1, HEIGHT, 1);
    const cm_image to = floats(map, WIDTH, HEIGHT, 1), to_again = floats(again, WIDTH, HEIGHT, 1);
    for (size_t k = 0; k < MEASURES; k++)
    {
        cm_compare_options options = standard();
        cm_map_figures found = no_map(), more = no_map();
        double sum = 0, all = 0;
        options.weights = &weights;
        options.border = 2;
        options.pixels_per_degree = 30.0;
        options.threads = 1;
        ck_assert_int_eq(measures[k](&a, &b, &options, &found, &to), CM_OK);
        for (size_t i = 0; i < COUNT; i++)
        {
            const size_t x = i % WIDTH, y = i / WIDTH;
            const int counts = x >= 2 && x < WIDTH - 2 && y >= 2 && y < HEIGHT - 2 && y != 20;
            ck_assert(counts == !isnan(map[i]));
            sum += counts ? (double)map[i] * (double)rows[y] : 0;
            all += counts ? (double)rows[y] : 0;
        }
        expect_near(found.mean, sum / all, 1e-7, "mean");
        expect_near(found.weight, all, 1e-12, "weight");
        ck_assert(found.pixels == (WIDTH - 4) * (HEIGHT - 5));
        for (options.threads = 0; options.threads < 4; options.threads++)
        {
            ck_assert_int_eq(measures[k](&a, &b, &options, &more, &to_again), CM_OK);
            ck_assert(memcmp(&found, &more, sizeof found) == 0);
            ck_assert(memcmp(map, again, sizeof map) == 0);
        }
    }
}
END_TEST

START_TEST(windows_with_what_is_not_finite)
{
    enum
    {
        WIDTH = 40,
        HEIGHT = 30,
        COUNT = WIDTH * HEIGHT
    };
    static float one[COUNT * 3], other[COUNT * 3], map[COUNT], weight[COUNT];
    make_pictures(WIDTH, HEIGHT, 3, one, other);
    const cm_image a = floats(one, WIDTH, HEIGHT, 3), b = floats(other, WIDTH, HEIGHT, 3);
    const cm_image to = floats(map, WIDTH, HEIGHT, 1), weights = floats(weight, WIDTH, HEIGHT, 1);
    static const float bad[] = {NOT_A_NUMBER, INFINITE, -INFINITE};
    static const long reach[MEASURES] = {5, 10, 10};
    for (size_t k = 0; k < MEASURES; k++)
    {
        for (size_t i = 0; i < 3; i++)
        {
            cm_compare_options options = standard();
            cm_map_figures found = no_map();
            const float kept = other[3 * (14 * WIDTH + 17) + 1];
            other[3 * (14 * WIDTH + 17) + 1] = bad[i];
            found.mean = 5.0;
            ck_assert_int_eq(measures[k](&a, &b, NULL, &found, &to), CM_ERROR_RANGE);
            ck_assert(found.mean == 5.0);
            options.not_finite = CM_COMPARE_SKIP;
            ck_assert_int_eq(measures[k](&a, &b, &options, &found, &to), CM_OK);
            const long edge = 2 * reach[k] + 1;
            ck_assert(found.not_finite == (uint64_t)(edge * edge) && !isnan(found.mean));
            for (long j = 0; j < COUNT; j++)
            {
                const int is_near =
                    labs(j % WIDTH - 17) <= reach[k] && labs(j / WIDTH - 14) <= reach[k];
                ck_assert(is_near == !!isnan(map[j]));
                weight[j] = is_near ? 0.0f : 1.0f;
            }
            options.not_finite = CM_COMPARE_REFUSE;
            options.weights = &weights;
            ck_assert_int_eq(measures[k](&a, &b, &options, &found, &to), CM_OK);
            options.not_finite = CM_COMPARE_ALIKE;
            ck_assert_int_eq(measures[k](&a, &b, &options, &found, &to), CM_ERROR_ARGUMENT);
            other[3 * (14 * WIDTH + 17) + 1] = kept;
        }
    }
}
END_TEST

START_TEST(one_pixel)
{
    float dark[3] = {0.25f, 0.25f, 0.25f}, bright[3] = {0.75f, 0.75f, 0.75f}, map = 0.0f;
    const cm_image a = floats(dark, 1, 1, 3), b = floats(bright, 1, 1, 3);
    const cm_image to = floats(&map, 1, 1, 1);
    for (size_t k = 0; k < MEASURES; k++)
    {
        cm_map_figures found = no_map();
        cm_compare_options options = standard();
        ck_assert_int_eq(measures[k](&a, &b, NULL, &found, &to), CM_OK);
        ck_assert(found.pixels == 1 && found.mean > 0.0 && found.mean < 1.0);
        ck_assert((float)found.mean == map);
        options.border = 1;
        ck_assert_int_eq(measures[k](&a, &b, &options, &found, &to), CM_OK);
        ck_assert(found.pixels == 0 && isnan(found.mean) && isnan(found.lowest) && isnan(map));
    }
}
END_TEST

START_TEST(wrong_arguments)
{
    float values[12] = {0}, weight[4] = {1, 1, 1, 1};
    const cm_image good = floats(values, 2, 2, 3), map = floats(weight, 2, 2, 1);
    const cm_image narrow = floats(values, 1, 2, 3);
    for (size_t k = 0; k < MEASURES; k++)
    {
        cm_map_figures found = no_map();
        for (int i = 0; i < 6; i++)
        {
            cm_image wrong = good;
            wrong.size -= i == 0;
            wrong.data = i == 1 ? NULL : wrong.data;
            wrong.type = i == 2 ? (cm_pixel_type)4 : wrong.type;
            wrong.width *= i != 3;
            wrong.height *= i != 4;
            wrong.channels = i == 5 ? 65 : wrong.channels;
            ck_assert_int_eq(measures[k](&good, &wrong, NULL, NULL, NULL), CM_ERROR_ARGUMENT);
            ck_assert_int_eq(measures[k](&wrong, &good, NULL, NULL, NULL), CM_ERROR_ARGUMENT);
        }
        ck_assert_int_eq(measures[k](&good, &narrow, NULL, NULL, NULL), CM_ERROR_RANGE);
        ck_assert_int_eq(measures[k](NULL, &good, NULL, NULL, NULL), CM_ERROR_ARGUMENT);
        ck_assert_int_eq(measures[k](&good, &good, NULL, NULL, &good), CM_ERROR_ARGUMENT);
        ck_assert_int_eq(measures[k](&narrow, &narrow, NULL, NULL, &map), CM_ERROR_RANGE);
        found.size = 0;
        ck_assert_int_eq(measures[k](&good, &good, NULL, &found, NULL), CM_ERROR_ARGUMENT);
    }
    for (int i = 0; i < 10; i++)
    {
        cm_compare_options options = standard();
        options.size -= i == 0;
        options.not_finite = i == 1 ? (cm_compare_not_finite)3 : CM_COMPARE_REFUSE;
        options.peak = i == 2   ? -1.0
                       : i == 3 ? (double)NAN
                       : i == 8 ? 1e-101
                       : i == 9 ? (double)INFINITY
                                : 0.0;
        options.pixels_per_degree = i == 4 ? 0.001 : i == 5 ? 1000.5 : 0.0;
        options.exposure_start = i == 6 ? 1.0 : 0.0;
        options.exposure_count = i == 7 ? CM_FLIP_EXPOSURES_MAX + 1 : 0;
        cm_error_figures found = no_figures();
        ck_assert_int_eq(cm_flip(&good, &good, &options, NULL, NULL), CM_ERROR_ARGUMENT);
        ck_assert_int_eq(cm_compare_errors(&good, &good, &options, &found), CM_ERROR_ARGUMENT);
    }
    cm_compare_options options = standard();
    options.weights = &map;
    static const float wrong_weights[] = {-1.0f, NOT_A_NUMBER, INFINITE};
    for (size_t i = 0; i < 3; i++)
    {
        weight[3] = wrong_weights[i];
        ck_assert_int_eq(cm_flip(&good, &good, &options, NULL, NULL), CM_ERROR_RANGE);
    }
    options.weights = &good;
    ck_assert_int_eq(cm_flip(&good, &good, &options, NULL, NULL), CM_ERROR_ARGUMENT);
    cm_errors *errors = NULL;
    ck_assert_int_eq(cm_errors_create(3, &options, &errors), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_errors_create(0, NULL, &errors), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_errors_create(65, NULL, &errors), CM_ERROR_ARGUMENT);
    ck_assert_ptr_null(errors);
    ck_assert_int_eq(cm_compare_errors(&good, &good, NULL, NULL), CM_ERROR_ARGUMENT);
}
END_TEST

/* ---------------------------------------------------------------- weights and points */

START_TEST(faces_have_the_area_of_the_sphere)
{
    enum
    {
        EDGE = 128
    };
    static float weights[EDGE * EDGE];
    static const char *const names[] = {"gnomonic", "coupled", "qsc", "tangent", "healpix"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
    {
        cm_mapping *const mapping = make_mapping(names[k], NULL);
        for (uint8_t face = 0; face < 6; face++)
        {
            double sum = 0;
            ck_assert_int_eq(cm_face_weights(mapping, face, EDGE, face, weights), CM_OK);
            for (size_t i = 0; i < EDGE * EDGE; i++)
            {
                sum += (double)weights[i];
            }
            REQUIRE(fabs(sum - 2.0 * PI / 3.0) < 1e-3, "%s, face %d: %.9g", names[k], face, sum);
        }
        ck_assert_int_eq(cm_face_weights(mapping, 6, EDGE, 1, weights), CM_ERROR_ARGUMENT);
        ck_assert_int_eq(cm_face_weights(mapping, 0, 0, 1, weights), CM_ERROR_ARGUMENT);
        cm_mapping_destroy(mapping);
    }
    /* gnomonic: 1 / (1 + u^2 + v^2)^(3/2) */
    cm_mapping *const mapping = make_mapping("gnomonic", NULL);
    ck_assert_int_eq(cm_face_weights(mapping, 3, 4, 1, weights), CM_OK);
    expect_near((double)weights[0], 0.25 * pow(2.125, -1.5), 1e-8, "corner");
    expect_near((double)weights[6], 0.25 * pow(1.125, -1.5), 1e-8, "middle");
    cm_mapping_destroy(mapping);
    float rows[2];
    ck_assert_int_eq(cm_equirect_weights(4, 2, rows), CM_OK);
    expect_near((double)rows[0], PI / 2.0, 1e-7, "a quarter of a half");
    ck_assert(rows[0] == rows[1]);
    ck_assert_int_eq(cm_equirect_weights(0, 2, rows), CM_ERROR_ARGUMENT);
}
END_TEST

/* Means over the points of what has the mean 0 on the sphere are small, whichever part of them is made at a time. */
START_TEST(points_are_even)
{
    enum
    {
        COUNT = 20000
    };
    static double x[COUNT], y[COUNT], z[COUNT];
    double sum[9] = {0};
    for (uint64_t first = 0; first < COUNT; first += 4321)
    {
        const size_t count = COUNT - first < 4321 ? (size_t)(COUNT - first) : 4321;
        ck_assert_int_eq(cm_sphere_points(COUNT, first, count, x + first, y + first, z + first),
                         CM_OK);
    }
    for (size_t i = 0; i < COUNT; i++)
    {
        expect_near(x[i] * x[i] + y[i] * y[i] + z[i] * z[i], 1.0, 1e-15, "length");
        const double terms[9] = {x[i],
                                 y[i],
                                 z[i],
                                 x[i] * y[i],
                                 y[i] * z[i],
                                 z[i] * x[i],
                                 x[i] * x[i] - 1.0 / 3.0,
                                 z[i] * z[i] - 1.0 / 3.0,
                                 x[i] * x[i] * x[i] * x[i] - 0.2};
        for (size_t k = 0; k < 9; k++)
        {
            sum[k] += terms[k] / COUNT;
        }
        ck_assert(i == 0 || z[i] < z[i - 1]);
    }
    for (size_t k = 0; k < 9; k++)
    {
        REQUIRE(fabs(sum[k]) < 1e-5, "%zu: %g", k, sum[k]);
    }
    /* no two are near: the area of each is 4 pi / n, and the lattice's least distance about 3.09 / sqrt(n) */
    double least = 4;
    for (size_t i = 0; i < COUNT; i += 7)
    {
        for (size_t j = i + 1; j < COUNT && z[i] - z[j] < 0.03; j++)
        {
            const double far = hypot(hypot(x[i] - x[j], y[i] - y[j]), z[i] - z[j]);
            least = far < least ? far : least;
        }
    }
    REQUIRE(least > 3.0 / sqrt(COUNT), "%g", least * sqrt(COUNT));
    ck_assert_int_eq(cm_sphere_points(CM_SPHERE_POINTS, CM_SPHERE_POINTS - 1, 1, x, y, z), CM_OK);
    expect_near(z[0], 1.0 / CM_SPHERE_POINTS - 1.0, 1e-16, "the last one");
    ck_assert_int_eq(cm_sphere_points(10, 9, 2, x, y, z), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_sphere_points(10, 10, 0, x, y, z), CM_OK);
    ck_assert_int_eq(cm_sphere_points(10, 0, 1, NULL, y, z), CM_ERROR_ARGUMENT);
}
END_TEST

/* ---------------------------------------------------------------- maps */

static void blue_to_red(double t, double color[3], void *user)
{
    ++*(int *)user;
    color[0] = isnan(t) ? 0.5 : t;
    color[1] = isnan(t) ? (double)NAN : 2.0;
    color[2] = isnan(t) ? 0.5 : 1.0 - t;
}

START_TEST(maps_of_differences)
{
    float one[4][2] = {{0, 1}, {1, 1}, {2, NOT_A_NUMBER}, {INFINITE, 0}};
    float other[4][2] = {{0.25f, 3}, {1, 1}, {9, 1}, {INFINITE, 0}};
    float map[4];
    const cm_image a = floats(one[0], 2, 2, 2), b = floats(other[0], 2, 2, 2);
    const cm_image to = floats(map, 2, 2, 1);
    ck_assert_int_eq(cm_difference_map(&a, &b, 1, &to), CM_OK);
    ck_assert(map[0] == 2.0f && map[1] == 0.0f && isnan(map[2]) && isnan(map[3]));
    map[3] = 0.5f;
    uint8_t bytes[4][4];
    uint16_t words[4][3];
    float numbers[4][3];
    int calls = 0;
    uint64_t beyond = 9;
    const cm_image colors = image_of(bytes[0], CM_PIXEL_U8, 2, 2, 4);
    ck_assert_int_eq(cm_draw_map(&to, 0.0, 1.0, blue_to_red, &calls, &colors, &beyond), CM_OK);
    const uint8_t expected[4][4] = {
        {255, 255, 0, 255}, {0, 255, 255, 255}, {128, 0, 128, 255}, {128, 255, 128, 255}};
    ck_assert(memcmp(bytes, expected, sizeof bytes) == 0);
    ck_assert(calls == 4 && beyond == 1);
    const cm_image deep = image_of(words[0], CM_PIXEL_U16, 2, 2, 3);
    ck_assert_int_eq(cm_draw_map(&to, 0.0, 2.0, blue_to_red, &calls, &deep, NULL), CM_OK);
    ck_assert(words[3][0] == 16384 && words[3][2] == 49151 && words[2][1] == 0);
    const cm_image real = floats(numbers[0], 2, 2, 3);
    ck_assert_int_eq(cm_draw_map(&to, 0.0, 2.0, blue_to_red, &calls, &real, NULL), CM_OK);
    ck_assert(numbers[3][0] == 0.25f && numbers[3][1] == 2.0f && isnan(numbers[2][1]));
    const cm_image half = image_of(words[0], CM_PIXEL_HALF, 2, 2, 3);
    ck_assert_int_eq(cm_draw_map(&to, 0.0, 2.0, blue_to_red, &calls, &half, NULL), CM_OK);
    ck_assert(words[3][0] == 0x3400 && words[3][1] == 0x4000 && words[2][1] == 0x7e00);
    ck_assert_int_eq(cm_draw_map(&to, 1.0, 1.0, blue_to_red, &calls, &real, NULL),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_draw_map(&a, 0.0, 1.0, blue_to_red, &calls, &real, NULL),
                     CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_draw_map(&to, 0.0, 1.0, NULL, &calls, &real, NULL), CM_ERROR_ARGUMENT);
    ck_assert_int_eq(cm_draw_map(&to, 0.0, 1.0, blue_to_red, &calls, &a, NULL), CM_ERROR_RANGE);
}
END_TEST

static void same(double t, double color[3], void *user)
{
    (void)user;
    color[0] = color[1] = color[2] = t * 131072.0 - 65536.0;
}

/* Halves are the nearest ones, ties to even: the neighbours of every one are found again. */
START_TEST(halves_are_the_nearest)
{
    for (uint32_t bits = 0; bits < 0x7c00; bits += (uint32_t)step_of(17))
    {
        uint16_t pixel[3], back[3] = {(uint16_t)bits, (uint16_t)bits, (uint16_t)bits};
        float map = 0.0f, zero[3] = {0};
        const cm_image half = image_of(back, CM_PIXEL_HALF, 1, 1, 3);
        const cm_image none = floats(zero, 1, 1, 3), to = floats(&map, 1, 1, 1);
        const cm_image drawn = image_of(pixel, CM_PIXEL_HALF, 1, 1, 3);
        ck_assert_int_eq(cm_difference_map(&none, &half, 1, &to), CM_OK);
        const double above = bits >= 0x400 ? ldexp(1.0, (int)(bits >> 10) - 25) : ldexp(1.0, -24);
        const double value = (double)map;
        for (int k = -1; k <= 1; k++)
        {
            /* just within half a step: below a power of two a step is half as long */
            const double moved = value + k * (k < 0 ? 0.24 : 0.49) * above;
            map = (float)((moved + 65536.0) / 131072.0);
            if ((double)map * 131072.0 - 65536.0 != moved)
            {
                continue; /* the map's floats do not have it */
            }
            ck_assert_int_eq(cm_draw_map(&to, 0.0, 1.0, same, NULL, &drawn, NULL), CM_OK);
            REQUIRE(pixel[0] == bits || (bits == 0 && pixel[0] == 0x8000), "%x: %x", bits,
                    pixel[0]);
        }
    }
}
END_TEST

/* ---------------------------------------------------------------- without memory */

#ifdef WRAPS_ALLOCATION
START_TEST(without_memory)
{
    float values[12] = {0};
    const cm_image good = floats(values, 2, 2, 3);
    for (size_t k = 0; k <= MEASURES; k++)
    {
        cm_status status = CM_ERROR_MEMORY;
        int given = 0;
        for (; status == CM_ERROR_MEMORY && given < 20; given++)
        {
            cm_map_figures map = no_map();
            cm_error_figures figures = no_figures();
            map.mean = figures.mse = 3.0;
            cm_compare_options options = standard();
            options.threads = 1;
            left_to_give = given;
            status = k < MEASURES ? measures[k](&good, &good, &options, &map, NULL)
                                  : cm_compare_errors(&good, &good, &options, &figures);
            left_to_give = -1;
            ck_assert(status == CM_OK || (map.mean == 3.0 && figures.mse == 3.0));
        }
        REQUIRE(status == CM_OK && given > 3, "measure %zu, %d", k, given);
    }
}
END_TEST
#endif

int main(void)
{
    const TTest *const tests[] = {a_constant_offset,
                                  a_single_pixel,
                                  channels_alone,
                                  errors_by_solid_angle,
                                  blocks_and_threads_change_no_bit,
                                  every_type_of_pixel,
                                  what_is_not_finite,
                                  refused_rows_are_not_added,
                                  values_at_points,
                                  ssim_is_that_of_the_formula,
                                  ssim_has_limits,
                                  flip_is_that_of_the_formulas,
                                  flip_is_that_of_the_authors,
                                  flip_of_constant_pictures,
                                  flip_is_symmetric,
                                  flip_of_high_dynamic_range,
                                  exposures_of_dark_pictures,
                                  maps_have_weighted_means,
                                  windows_with_what_is_not_finite,
                                  one_pixel,
                                  wrong_arguments,
                                  faces_have_the_area_of_the_sphere,
                                  points_are_even,
                                  maps_of_differences,
                                  halves_are_the_nearest,
#ifdef WRAPS_ALLOCATION
                                  without_memory,
#endif
                                  NULL};
    return run_suite("compare", tests);
}
