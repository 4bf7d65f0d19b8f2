/* SPDX-License-Identifier: MIT
 *
 * How far pictures are from each other, value by value; solid angles, even points and maps; what the measures refuse.
 */
#include <cubemap/threads.h>

#include "compared_pictures.h"

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

/* ---------------------------------------------------------------- arguments */

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
