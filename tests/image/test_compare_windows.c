/* SPDX-License-Identifier: MIT
 *
 * Measures with windows, SSIM and FLIP: against closed forms and slow formulas of the tests' own.
 */
#include "compared_pictures.h"
#include "own_flip.h"

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

/* Figures of the steps and constants of the authors' program (github.com/NVlabs/flip, python/flip_api.py at commit
 * 313517b), written again in NumPy's double precision, cv.filter2D as scipy.ndimage.correlate(mode="nearest"). It gives inverse
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

int main(void)
{
    const TTest *const tests[] = {ssim_is_that_of_the_formula,
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
                                  NULL};
    return run_suite("compare windows", tests);
}
