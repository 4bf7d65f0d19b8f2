/* SPDX-License-Identifier: MIT
 *
 * The loops over pixels of every instruction set, against sums in double, at hard points: whole positions, halves, one
 * ulp beside them, the first and the last that a window has, the least and the greatest values.
 */
#include "tests/suite.h"

#include "modules/image/filter_weights.h"
#include "modules/image/sample_set.h"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

enum
{
    WIDTH = 37,
    HEIGHT = 23,
    CHANNELS_MOST = 5,
    GUARD = 64,
    KINDS = 7, /* of hard positions; further ones are random */
    REPETITIONS = 8,
    COUNT = CM_SAMPLES_MAX
};

/* ---- random numbers, the same each time ---- */

static uint32_t random_state = 1;

static uint32_t random_bits(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    return random_state >> 8;
}

static double random_unit(void)
{
    return random_bits() / 16777216.0;
}

/* ---- the sets of this machine ---- */

static const cm_sample_set *set_at(size_t index)
{
    const char *name = cm_instructions_at(index);
    const cm_sample_set *set = cm_sample_set_find(name);
    REQUIRE(set != NULL, "%s", name);
    ck_assert_str_eq(set->name, name);
    return set;
}

/* A loop and what it should do. */
typedef struct loop
{
    const char *name;
    cm_sampler *sampler;
    cm_pixel_type type;
    cm_filter filter;
} loop;

enum
{
    LOOPS = 15
};

static const char *name_of(cm_filter filter)
{
    static const char *const names[] = {"auto",     "nearest",  "bilinear", "Catmull-Rom",
                                        "Mitchell", "Lanczos3", "spline36", "bspline5"};
    return names[filter];
}

static void list_loops(const cm_sample_set *set, loop loops[LOOPS])
{
    const loop all[LOOPS] = {
        {"nearest_u8", set->nearest_u8, CM_PIXEL_U8, CM_FILTER_NEAREST},
        {"nearest_u16", set->nearest_u16, CM_PIXEL_U16, CM_FILTER_NEAREST},
        {"nearest_float", set->nearest_float, CM_PIXEL_FLOAT, CM_FILTER_NEAREST},
        {"bilinear_u8", set->bilinear_u8, CM_PIXEL_U8, CM_FILTER_BILINEAR},
        {"bilinear_u16", set->bilinear_u16, CM_PIXEL_U16, CM_FILTER_BILINEAR},
        {"bilinear_float", set->bilinear_float, CM_PIXEL_FLOAT, CM_FILTER_BILINEAR},
        {"taps4_u8", set->taps4_u8, CM_PIXEL_U8, CM_FILTER_CATMULL_ROM},
        {"taps4_u8", set->taps4_u8, CM_PIXEL_U8, CM_FILTER_MITCHELL},
        {"taps4_float", set->taps4_float, CM_PIXEL_FLOAT, CM_FILTER_CATMULL_ROM},
        {"taps4_float", set->taps4_float, CM_PIXEL_FLOAT, CM_FILTER_MITCHELL},
        {"taps6_u8", set->taps6_u8, CM_PIXEL_U8, CM_FILTER_LANCZOS3},
        {"taps6_u8", set->taps6_u8, CM_PIXEL_U8, CM_FILTER_SPLINE36},
        {"taps6_float", set->taps6_float, CM_PIXEL_FLOAT, CM_FILTER_LANCZOS3},
        {"taps6_float", set->taps6_float, CM_PIXEL_FLOAT, CM_FILTER_SPLINE36},
        {"taps6_float", set->taps6_float, CM_PIXEL_FLOAT, CM_FILTER_BSPLINE5},
    };
    memcpy(loops, all, sizeof all);
}

static size_t bytes_of(cm_pixel_type type)
{
    return type == CM_PIXEL_U8 ? 1 : type == CM_PIXEL_FLOAT ? 4 : 2;
}

static unsigned taps_of(cm_filter filter)
{
    return filter == CM_FILTER_NEAREST    ? 0
           : filter == CM_FILTER_BILINEAR ? 2
                                          : cm_filter_taps(filter);
}

static double most_of(cm_pixel_type type)
{
    return type == CM_PIXEL_U8 ? 255.0 : type == CM_PIXEL_U16 ? 65535.0 : 1.0;
}

/* NULL for filters without one. */
static const cm_filter_table *table_of(cm_filter filter)
{
    static cm_filter_table tables[CM_FILTER_BSPLINE5 + 1];
    static int is_filled[CM_FILTER_BSPLINE5 + 1];
    if (taps_of(filter) < 4)
    {
        return NULL;
    }
    if (!is_filled[filter])
    {
        cm_filter_table_fill(filter, &tables[filter]);
        is_filled[filter] = 1;
    }
    return &tables[filter];
}

/* ---- pictures ---- */

/* The values of a picture, and the same as pixels in memory of exactly the size that loops may read. */
typedef struct picture
{
    double value[HEIGHT][WIDTH][CHANNELS_MOST];
    char *memory;
    cm_window window;
    cm_pixel_type type;
} picture;

static double get(const void *from, cm_pixel_type type, size_t index)
{
    return type == CM_PIXEL_U8    ? ((const uint8_t *)from)[index]
           : type == CM_PIXEL_U16 ? ((const uint16_t *)from)[index]
                                  : (double)((const float *)from)[index];
}

static void put(void *to, cm_pixel_type type, size_t index, double value)
{
    if (type == CM_PIXEL_U8)
    {
        ((uint8_t *)to)[index] = (uint8_t)value;
    }
    else if (type == CM_PIXEL_U16)
    {
        ((uint16_t *)to)[index] = (uint16_t)value;
    }
    else
    {
        ((float *)to)[index] = (float)value;
    }
}

typedef double value_at(cm_pixel_type type, int column, int row, unsigned channel);

/* What may be read and not used is NaN, or 255. If rows are upside down, the stride is negative. */
static void make_picture(picture *made, cm_pixel_type type, uint32_t channels, int upside_down,
                         value_at *value)
{
    const size_t row_bytes = WIDTH * channels * bytes_of(type) + CM_WINDOW_SLACK;
    made->type = type;
    made->memory = malloc(HEIGHT * row_bytes);
    ck_assert_ptr_nonnull(made->memory);
    memset(made->memory, 0xff, HEIGHT * row_bytes);
    made->window.channels = channels;
    made->window.row_stride = upside_down ? -(ptrdiff_t)row_bytes : (ptrdiff_t)row_bytes;
    char *first = made->memory + (upside_down ? (HEIGHT - 1) * row_bytes : 0);
    made->window.data = first;
    for (int j = 0; j < HEIGHT; j++)
    {
        for (int i = 0; i < WIDTH; i++)
        {
            for (unsigned c = 0; c < channels; c++)
            {
                char *row = first + j * made->window.row_stride;
                put(row, type, (size_t)i * channels + c, value(type, i, j, c));
                made->value[j][i][c] = get(row, type, (size_t)i * channels + c);
            }
        }
    }
}

/* A third each of the least, the greatest and what is between. */
static double noise(cm_pixel_type type, int column, int row, unsigned channel)
{
    (void)column, (void)row, (void)channel;
    const double most = most_of(type);
    const uint32_t kind = random_bits() % 3;
    const double between =
        type == CM_PIXEL_FLOAT ? random_unit() : floor(random_unit() * (most + 1.0));
    return kind == 0 ? 0.0 : kind == 1 ? most : between;
}

static double ramp(cm_pixel_type type, int column, int row, unsigned channel)
{
    const double steps = 3.0 * column + 4.0 * row + channel;
    return type == CM_PIXEL_FLOAT ? steps / 256.0 : type == CM_PIXEL_U8 ? steps : 200.0 * steps;
}

/* Twelve pixels a wave. */
static double waves(cm_pixel_type type, int column, int row, unsigned channel)
{
    const double wave = sin(0.52 * column + 0.3 * channel) * cos(0.52 * row);
    const double middle = most_of(type) * (0.5 + 0.45 * wave);
    return type == CM_PIXEL_FLOAT ? middle : round(middle);
}

/* ---- positions ---- */

typedef struct positions
{
    float x[COUNT];
    float y[COUNT];
} positions;

/* A position whose taps are within size pixels. */
static float position_within(int size, unsigned taps, uint32_t kind)
{
    const int before = taps == 0 ? 0 : (int)taps / 2 - 1;
    const int after = (int)taps / 2;
    const int first = before;
    const int last = size - 1 - after;
    const float whole = (float)(first + (int)(random_bits() % (uint32_t)(last - first + 1)));
    switch (kind)
    {
    case 0:
        return taps == 0 ? -0.5f : (float)first;
    case 1:
        return taps == 0 ? nextafterf((float)last + 0.5f, 0.0f)
                         : nextafterf((float)(last + 1), 0.0f);
    case 2:
        return whole;
    case 3:
        return taps == 0 ? whole : nextafterf(whole + 1.0f, 0.0f);
    case 4:
        return nextafterf(whole, (float)size);
    case 5:
        return taps == 0 && whole >= (float)last ? whole : whole + 0.5f;
    case 6:
        return taps == 0 && whole >= (float)last ? whole : nextafterf(whole + 0.5f, 0.0f);
    default:
        return taps == 0 ? (float)(random_unit() * (size - 1))
                         : whole + (float)random_bits() / 16777216.0f;
    }
}

static void make_positions(positions *at, unsigned taps)
{
    for (uint32_t i = 0; i < COUNT; i++)
    {
        at->x[i] = position_within(WIDTH, taps, i % 10);
        at->y[i] = position_within(HEIGHT, taps, i / 10 % 10);
    }
}

/* ---- the truth ---- */

/* The sum of taps, in double. */
static double true_value(const picture *from, cm_filter filter, float x, float y, unsigned channel)
{
    const unsigned taps = taps_of(filter);
    if (taps == 0)
    {
        return from->value[(int)floor((double)y + 0.5)][(int)floor((double)x + 0.5)][channel];
    }
    const int column = (int)floorf(x);
    const int row = (int)floorf(y);
    double weights_x[CM_FILTER_TAPS_MAX] = {1.0 - ((double)x - column), (double)x - column};
    double weights_y[CM_FILTER_TAPS_MAX] = {1.0 - ((double)y - row), (double)y - row};
    if (taps > 2)
    {
        cm_filter_weights(filter, (double)x - column, weights_x);
        cm_filter_weights(filter, (double)y - row, weights_y);
    }
    double sum = 0.0;
    for (unsigned j = 0; j < taps; j++)
    {
        for (unsigned i = 0; i < taps; i++)
        {
            const int before = (int)taps / 2 - 1;
            sum += weights_y[j] * weights_x[i] *
                   from->value[row - before + (int)j][column - before + (int)i][channel];
        }
    }
    return from->type == CM_PIXEL_FLOAT ? sum : fmin(fmax(sum, 0.0), most_of(from->type));
}

/* How far a loop may be from it. Bytes: rounding, and 1/512 of a pixel each way where weights are of phases, which
 * moves the sum by twice the greatest value a pixel at most. Float: 64 segments of parabolas, and some ulps. */
static double allowance(const loop *which)
{
    const unsigned taps = taps_of(which->filter);
    if (taps == 0)
    {
        return 0.0;
    }
    if (which->type == CM_PIXEL_FLOAT)
    {
        return taps == 2 ? 3e-7 : 3e-6;
    }
    return taps > 2 ? 0.5 + 255.0 * 2.0 * 2.0 / 512.0 : which->type == CM_PIXEL_U8 ? 0.53 : 0.52;
}

/* ---- calls ---- */

/* The values at n positions in out, which the loop may not write beyond. */
static void call(const loop *which, const picture *from, size_t n, const float *x, const float *y,
                 double *out)
{
    const size_t size = n * from->window.channels * bytes_of(which->type);
    char *to = malloc(size + 2 * GUARD);
    ck_assert_ptr_nonnull(to);
    memset(to, 0xa5, size + 2 * GUARD);
    which->sampler(&from->window, n, x, y, table_of(which->filter), to + GUARD);
    for (size_t i = 0; i < GUARD; i++)
    {
        REQUIRE((uint8_t)to[i] == 0xa5 && (uint8_t)to[GUARD + size + i] == 0xa5,
                "%s, %u channels: written beside its array", which->name, from->window.channels);
    }
    for (size_t i = 0; i < n * from->window.channels; i++)
    {
        out[i] = get(to + GUARD, which->type, i);
    }
    free(to);
}

typedef void loop_check(const cm_sample_set *set, const loop *which, uint32_t channels);

static void for_every_loop(loop_check *check)
{
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        loop loops[LOOPS];
        list_loops(set_at(s), loops);
        for (size_t k = 0; k < LOOPS; k++)
        {
            for (uint32_t channels = 1; channels <= CHANNELS_MOST; channels++)
            {
                check(set_at(s), &loops[k], channels);
            }
        }
    }
}

/* ---- against the truth ---- */

static void check_truth(const cm_sample_set *set, const loop *which, uint32_t channels)
{
    static double out[COUNT * CHANNELS_MOST];
    static picture from;
    for (int upside_down = 0; upside_down < 2; upside_down++)
    {
        positions at;
        make_picture(&from, which->type, channels, upside_down, noise);
        make_positions(&at, taps_of(which->filter));
        call(which, &from, COUNT, at.x, at.y, out);
        for (size_t i = 0; i < COUNT * channels; i++)
        {
            const float x = at.x[i / channels];
            const float y = at.y[i / channels];
            const double truth = true_value(&from, which->filter, x, y, (unsigned)(i % channels));
            REQUIRE(fabs(out[i] - truth) <= allowance(which),
                    "%s %s %s, %u channels, %.9g %.9g: %.9g for %.9g", set->name, which->name,
                    name_of(which->filter), channels, (double)x, (double)y, out[i], truth);
        }
        free(from.memory);
    }
}

START_TEST(values_are_true)
{
    for_every_loop(check_truth);
}
END_TEST

/* ---- the same wherever it is ---- */

static void check_position(const cm_sample_set *set, const loop *which, uint32_t channels)
{
    static double all[COUNT * CHANNELS_MOST];
    static double some[COUNT * CHANNELS_MOST];
    static picture from;
    positions at;
    make_picture(&from, which->type, channels, 0, noise);
    make_positions(&at, taps_of(which->filter));
    call(which, &from, COUNT, at.x, at.y, all);
    for (size_t first = 0; first + 16 <= COUNT; first += 23)
    {
        call(which, &from, 16, at.x + first, at.y + first, some);
        REQUIRE(memcmp(some, all + first * channels, 16 * channels * sizeof *all) == 0,
                "%s %s, %u channels, from %zu", set->name, which->name, channels, first);
    }
    free(from.memory);
}

START_TEST(values_do_not_depend_on_the_place_in_an_array)
{
    for_every_loop(check_position);
}
END_TEST

/* ---- bilinear bytes are the same bits in all sets ---- */

static void check_bits(const cm_sample_set *set, const loop *which, uint32_t channels)
{
    static double here[COUNT * CHANNELS_MOST];
    static double plain[COUNT * CHANNELS_MOST];
    static picture from;
    loop loops[LOOPS];
    positions at;
    if (which->sampler != set->bilinear_u8)
    {
        return;
    }
    list_loops(&cm_sample_scalar, loops);
    make_picture(&from, CM_PIXEL_U8, channels, 0, noise);
    make_positions(&at, 2);
    call(which, &from, COUNT, at.x, at.y, here);
    call(&loops[3], &from, COUNT, at.x, at.y, plain);
    REQUIRE(memcmp(here, plain, COUNT * channels * sizeof *here) == 0, "%s, %u channels", set->name,
            channels);
    free(from.memory);
}

START_TEST(bilinear_bytes_are_those_of_the_scalar_set)
{
    for_every_loop(check_bits);
}
END_TEST

/* ---- constants, ramps, waves ---- */

static double constant;

static double constant_value(cm_pixel_type type, int column, int row, unsigned channel)
{
    (void)type, (void)column, (void)row, (void)channel;
    return constant;
}

static void check_constant(const cm_sample_set *set, const loop *which, uint32_t channels)
{
    static const double parts[] = {0.0, 1.0 / 255.0, 0.5, 127.0 / 255.0, 254.0 / 255.0, 1.0};
    static double out[COUNT * CHANNELS_MOST];
    static picture from;
    /* sums of weights in float are 1 but for some ulps */
    const double allowed = which->type == CM_PIXEL_FLOAT && taps_of(which->filter) > 2 ? 1e-6 : 0.0;
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
    {
        positions at;
        constant =
            which->type == CM_PIXEL_FLOAT ? parts[k] : floor(parts[k] * most_of(which->type));
        make_picture(&from, which->type, channels, 0, constant_value);
        make_positions(&at, taps_of(which->filter));
        call(which, &from, COUNT, at.x, at.y, out);
        for (size_t i = 0; i < COUNT * channels; i++)
        {
            REQUIRE(fabs(out[i] - from.value[0][0][0]) <= allowed * constant,
                    "%s %s %s, %u channels: %.9g for %.9g", set->name, which->name,
                    name_of(which->filter), channels, out[i], constant);
        }
        free(from.memory);
    }
}

START_TEST(constants_stay)
{
    for_every_loop(check_constant);
}
END_TEST

/* What a filter that is exact for straight lines makes of one. */
static void check_ramp(const cm_sample_set *set, const loop *which, uint32_t channels)
{
    static double out[COUNT * CHANNELS_MOST];
    static picture from;
    positions at;
    if (which->filter == CM_FILTER_NEAREST || which->filter == CM_FILTER_LANCZOS3)
    {
        return;
    }
    make_picture(&from, which->type, channels, 0, ramp);
    make_positions(&at, taps_of(which->filter));
    call(which, &from, COUNT, at.x, at.y, out);
    /* phases are up to 1/512 of a pixel beside */
    const double beside = taps_of(which->filter) > 2 ? 7.0 / 512.0 : 0.0;
    const double allowed = which->type == CM_PIXEL_FLOAT ? 2e-6 : 0.52 + beside;
    for (size_t i = 0; i < COUNT * channels; i++)
    {
        const double steps = 3.0 * (double)at.x[i / channels] + 4.0 * (double)at.y[i / channels] +
                             (double)(i % channels);
        const double truth = which->type == CM_PIXEL_FLOAT ? steps / 256.0
                             : which->type == CM_PIXEL_U8  ? steps
                                                           : 200.0 * steps;
        REQUIRE(fabs(out[i] - truth) <= allowed, "%s %s %s, %u channels: %.9g for %.9g", set->name,
                which->name, name_of(which->filter), channels, out[i], truth);
    }
    free(from.memory);
}

START_TEST(ramps_stay)
{
    for_every_loop(check_ramp);
}
END_TEST

/* Decibels below the greatest value: rounding to 255 steps alone leaves 58.9. */
static void check_noise(const cm_sample_set *set, const loop *which, uint32_t channels)
{
    static double out[COUNT * CHANNELS_MOST];
    static picture from;
    double squares = 0.0;
    if (which->filter == CM_FILTER_NEAREST)
    {
        return;
    }
    make_picture(&from, which->type, channels, 0, waves);
    for (int repetition = 0; repetition < REPETITIONS; repetition++)
    {
        positions at;
        for (size_t i = 0; i < COUNT; i++)
        {
            at.x[i] = position_within(WIDTH, taps_of(which->filter), KINDS);
            at.y[i] = position_within(HEIGHT, taps_of(which->filter), KINDS);
        }
        call(which, &from, COUNT, at.x, at.y, out);
        for (size_t i = 0; i < COUNT; i++)
        {
            const double truth = true_value(&from, which->filter, at.x[i], at.y[i], 0);
            squares += (out[i * channels] - truth) * (out[i * channels] - truth);
        }
    }
    const double ratio = most_of(which->type) / sqrt(squares / (REPETITIONS * COUNT));
    const double decibels = 20.0 * log10(ratio);
    const double wanted = which->type == CM_PIXEL_FLOAT ? 140.0
                          : which->type == CM_PIXEL_U8  ? 58.5
                                                        : 106.0;
    REQUIRE(decibels >= wanted, "%s %s %s, %u channels: %.2f dB", set->name, which->name,
            name_of(which->filter), channels, decibels);
    if (getenv("CUBEMAP_SHOW") != NULL && channels == 3)
    {
        printf("%s %s %s: %.2f dB\n", set->name, which->name, name_of(which->filter), decibels);
    }
    free(from.memory);
}

START_TEST(arithmetic_adds_little_to_rounding)
{
    for_every_loop(check_noise);
}
END_TEST

/* ---- weights ---- */

static double weight_at(cm_filter filter, double t, unsigned tap)
{
    double weights[CM_FILTER_TAPS_MAX];
    cm_filter_weights(filter, t, weights);
    return tap < cm_filter_taps(filter) ? weights[tap] : 0.0;
}

START_TEST(weights_are_the_filters)
{
    ck_assert_uint_eq(cm_filter_taps(CM_FILTER_AUTO), 0);
    ck_assert_uint_eq(cm_filter_taps(CM_FILTER_BILINEAR), 0);
    ck_assert_uint_eq(cm_filter_taps(CM_FILTER_EWA), 0);
    /* half way between two pixels: Keys 1981 for the first, B = C = 1/3 put into the formula, sinc by hand */
    ck_assert_double_eq_tol(weight_at(CM_FILTER_CATMULL_ROM, 0.5, 1), 9.0 / 16.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_CATMULL_ROM, 0.5, 0), -1.0 / 16.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_MITCHELL, 0.0, 1), 8.0 / 9.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_MITCHELL, 0.0, 0), 1.0 / 18.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_BSPLINE5, 0.0, 2), 66.0 / 120.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_BSPLINE5, 0.0, 1), 26.0 / 120.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_BSPLINE5, 0.0, 5), 0.0, 1e-15);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_BSPLINE5, 0.0, 0), 1.0 / 120.0, 1e-15);
    /* 6 / pi^2, -4 / (3 pi^2), 6 / (25 pi^2), before their sum is made 1 */
    const double sum = 2.0 * (6.0 - 4.0 / 3.0 + 6.0 / 25.0);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_LANCZOS3, 0.5, 2), 6.0 / sum, 1e-14);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_LANCZOS3, 0.5, 1), -4.0 / 3.0 / sum, 1e-14);
    ck_assert_double_eq_tol(weight_at(CM_FILTER_LANCZOS3, 0.5, 0), 6.0 / 25.0 / sum, 1e-14);
    for (int filter = CM_FILTER_CATMULL_ROM; filter <= CM_FILTER_BSPLINE5; filter++)
    {
        const unsigned taps = cm_filter_taps((cm_filter)filter);
        for (int k = 0; k <= 1000; k++)
        {
            double here[CM_FILTER_TAPS_MAX];
            double mirrored[CM_FILTER_TAPS_MAX];
            double total = 0.0;
            cm_filter_weights((cm_filter)filter, k / 1000.0, here);
            cm_filter_weights((cm_filter)filter, 1.0 - k / 1000.0, mirrored);
            for (unsigned i = 0; i < taps; i++)
            {
                total += here[i];
                ck_assert_double_eq_tol(here[i], mirrored[taps - 1 - i], 1e-14);
            }
            ck_assert_double_eq_tol(total, 1.0, 1e-15);
        }
        const int is_interpolating = filter != CM_FILTER_MITCHELL && filter != CM_FILTER_BSPLINE5;
        for (unsigned i = 0; i < taps && is_interpolating; i++)
        {
            ck_assert_double_eq_tol(weight_at((cm_filter)filter, 0.0, i), i == taps / 2 - 1, 1e-15);
        }
    }
}
END_TEST

START_TEST(tables_have_the_weights)
{
    for (int filter = CM_FILTER_CATMULL_ROM; filter <= CM_FILTER_BSPLINE5; filter++)
    {
        const cm_filter_table *table = table_of((cm_filter)filter);
        const unsigned taps = cm_filter_taps((cm_filter)filter);
        for (int p = 0; p <= CM_FILTER_PHASES; p++)
        {
            int sum = 0;
            for (unsigned i = 0; i < 8; i++)
            {
                const double weight = weight_at((cm_filter)filter, p / 256.0, i);
                sum += table->whole[p][i];
                ck_assert_double_eq_tol((double)table->real[p][i], weight, 6e-8);
                ck_assert_double_eq_tol(table->whole[p][i] / 16384.0, weight, 3.0 / 16384.0);
            }
            ck_assert_int_eq(sum, CM_FILTER_ONE);
        }
        double worst = 0.0;
        for (int k = 0; k <= 64 * 32; k++)
        {
            const double t = k / (64.0 * 32.0);
            const int s = k == 64 * 32 ? 63 : k / 32;
            const double u = 64.0 * t - s;
            for (unsigned i = 0; i < taps; i++)
            {
                const float(*terms)[8] = table->segments[s];
                const double sum =
                    (double)terms[0][i] + u * ((double)terms[1][i] + u * (double)terms[2][i]);
                worst = fmax(worst, fabs(sum - weight_at((cm_filter)filter, t, i)));
            }
        }
        REQUIRE(worst < 5e-7, "%s: %g", name_of((cm_filter)filter), worst);
    }
}
END_TEST

/* ---- conversions ---- */

static double true_half(uint16_t half)
{
    const int exponent = half >> 10 & 31;
    const double digits = half & 1023;
    const double size = exponent == 0    ? ldexp(digits, -24)
                        : exponent == 31 ? (digits == 0.0 ? (double)INFINITY : (double)NAN)
                                         : ldexp(1024.0 + digits, exponent - 25);
    return half & 0x8000 ? -size : size;
}

static int same(double a, double b)
{
    return isnan(a) ? isnan(b) : a == b && signbit(a) == signbit(b);
}

/* Programs may have the processor take floats below 2^-126 for 0; none is needed. */
static void flush_small_floats(int on)
{
#ifdef __SSE2__
    const unsigned flush = 0x8040; /* flush to zero, denormals are zeros */
    _mm_setcsr(on ? _mm_getcsr() | flush : _mm_getcsr() & ~flush);
#else
    (void)on;
#endif
}

START_TEST(halves_are_converted)
{
    enum
    {
        ALL = 65536
    };
    uint16_t *halves = malloc(ALL * sizeof *halves);
    uint16_t *back = malloc(ALL * sizeof *back);
    float *floats = malloc(ALL * sizeof *floats);
    ck_assert(halves != NULL && back != NULL && floats != NULL);
    for (int i = 0; i < ALL; i++)
    {
        halves[i] = (uint16_t)i;
    }
    for (size_t s = 0; s < 2 * cm_instructions_count(); s++)
    {
        const cm_sample_set *set = set_at(s / 2);
        flush_small_floats(s % 2);
        set->half_to_float(ALL, halves, 1.0f, floats);
        set->float_to_half(ALL, floats, 1.0f, back);
        flush_small_floats(0);
        for (int i = 0; i < ALL; i++)
        {
            REQUIRE(same((double)floats[i], true_half(halves[i])), "%s: %04x is %g", set->name, i,
                    (double)floats[i]);
            REQUIRE(back[i] == i || isnan(floats[i]), "%s: %04x is %04x", set->name, i, back[i]);
            REQUIRE(same(true_half(back[i]), (double)floats[i]), "%s: %04x", set->name, i);
        }
        /* between two halves the even one, and a float beside the middle the nearer one */
        for (unsigned i = 0; i < 0x7c00; i++)
        {
            const double above = i + 1 == 0x7c00 ? 65536.0 : true_half((uint16_t)(i + 1));
            const float middle = (float)(0.5 * (true_half((uint16_t)i) + above));
            const float at[3] = {nextafterf(middle, 0.0f), middle, nextafterf(middle, 1e9f)};
            uint16_t found[3];
            set->float_to_half(3, at, 1.0f, found);
            REQUIRE(found[0] == i && found[1] == (i & 1 ? i + 1 : i) && found[2] == i + 1,
                    "%s: %04x %04x %04x at %04x", set->name, found[0], found[1], found[2], i);
        }
    }
    free(halves);
    free(back);
    free(floats);
}
END_TEST

START_TEST(whole_numbers_are_converted)
{
    enum
    {
        N = 67
    };
    const float hard[] = {0.0f,
                          -0.0f,
                          0.5f,
                          1.5f,
                          2.5f,
                          254.5f,
                          255.0f,
                          255.5f,
                          256.0f,
                          65534.5f,
                          65535.0f,
                          65535.5f,
                          1e30f,
                          -1e30f,
                          (float)INFINITY,
                          -(float)INFINITY,
                          (float)NAN,
                          0.49999997f,
                          -0.5f,
                          1e-40f,
                          126.50001f,
                          126.49999f,
                          127.5f};
    float from[N];
    for (size_t i = 0; i < N; i++)
    {
        from[i] = hard[i % (sizeof hard / sizeof *hard)];
    }
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const cm_sample_set *set = set_at(s);
        for (size_t n = 0; n <= N; n++)
        {
            uint8_t bytes[N + 1];
            uint16_t words[N + 1];
            float back[N];
            memset(bytes, 0xa5, sizeof bytes);
            memset(words, 0xa5, sizeof words);
            set->float_to_u8(n, from, 1.0f, bytes);
            set->float_to_u16(n, from, 1.0f, words);
            for (size_t i = 0; i < n; i++)
            {
                const double value = isnan(from[i]) ? 0.0 : rint(fmax((double)from[i], 0.0));
                REQUIRE(bytes[i] == fmin(value, 255.0), "%s: %g is %d", set->name, (double)from[i],
                        bytes[i]);
                REQUIRE(words[i] == fmin(value, 65535.0), "%s: %g is %d", set->name,
                        (double)from[i], words[i]);
            }
            REQUIRE(bytes[n] == 0xa5 && words[n] == 0xa5a5, "%s: %zu", set->name, n);
            set->u8_to_float(n, bytes, 0.5f, back);
            for (size_t i = 0; i < n; i++)
            {
                ck_assert(back[i] == 0.5f * (float)bytes[i]);
            }
            set->u16_to_float(n, words, 0.5f, back);
            for (size_t i = 0; i < n; i++)
            {
                ck_assert(back[i] == 0.5f * (float)words[i]);
            }
        }
    }
}
END_TEST

START_TEST(sets_are_found)
{
    ck_assert_ptr_null(cm_sample_set_find("no such set"));
    ck_assert_str_eq(cm_sample_set_find("Scalar")->name, "scalar");
    if (getenv("CUBEMAP_INSTRUCTIONS") == NULL)
    {
        const char *best = cm_instructions_at(cm_instructions_count() - 1);
        ck_assert_str_eq(cm_sample_set_find(NULL)->name, best);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {weights_are_the_filters,
                                  tables_have_the_weights,
                                  sets_are_found,
                                  values_are_true,
                                  values_do_not_depend_on_the_place_in_an_array,
                                  bilinear_bytes_are_those_of_the_scalar_set,
                                  constants_stay,
                                  ramps_stay,
                                  arithmetic_adds_little_to_rounding,
                                  halves_are_converted,
                                  whole_numbers_are_converted,
                                  NULL};
    return run_suite("sample sets", tests);
}
