/* SPDX-License-Identifier: MIT
 *
 * The loops over pixels of every instruction set, against sums in double, at hard points: whole positions, halves, one
 * ulp beside them, the first and the last that a window has, the least and the greatest values.
 */
#include "sets_here.h"
#include "tests/suite.h"

#include "modules/image/filter_weights.h"
#include "modules/image/sample_set.h"

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

/* ---- loops ---- */

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

/* ---- sums of rows ---- */

enum
{
    ROWS_MOST = 6,
    SUMMED_MOST = 41,
    LEAST_SUMMED = 4
};

typedef enum row_kind
{
    ROWS_OF_BYTES,
    ROWS_OF_SCALED, /* bytes, summed as floats of which 255 is 1 */
    ROWS_OF_FLOATS
} row_kind;

/* Rows that end where nothing may be read any more, but for what LEAST_SUMMED allows. */
static void check_sums(const cm_sample_set *set, row_kind kind, size_t rows, size_t n)
{
    cm_row_summer *const sums[] = {set->sum_u8, set->sum_scaled_u8, set->sum_float};
    const int is_bytes = kind != ROWS_OF_FLOATS;
    const size_t size = is_bytes ? 1 : sizeof(float);
    const size_t room = n < LEAST_SUMMED ? LEAST_SUMMED : n;
    unsigned char *row[ROWS_MOST] = {NULL};
    float weight[ROWS_MOST] = {0.0f};
    float expected[SUMMED_MOST] = {0.0f};
    float *sum = malloc(room * sizeof *sum);
    for (size_t j = 0; j < rows; j++)
    {
        row[j] = calloc(room, size);
        weight[j] = (float)j * 0.37f - 0.71f;
        for (size_t i = 0; i < n; i++)
        {
            const uint8_t byte = (uint8_t)(i * 37 + j * 101 + 5);
            const float number = (float)byte * 0.123f - 7.0f;
            memcpy(row[j] + i * size, is_bytes ? (const void *)&byte : &number, size);
            expected[i] += weight[j] * (kind == ROWS_OF_BYTES    ? (float)byte
                                        : kind == ROWS_OF_SCALED ? (float)byte * (1.0f / 255.0f)
                                                                 : number);
        }
    }
    sums[kind](rows, weight, (const unsigned char *const *)row, n, sum);
    REQUIRE(memcmp(sum, expected, n * sizeof *sum) == 0, "%s: %zu rows of %zu", set->name, rows, n);
    for (size_t j = 0; j < rows; j++)
    {
        free(row[j]);
    }
    free(sum);
}

START_TEST(sums_of_rows_are_the_same_bits_in_all_sets)
{
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        for (size_t rows = 1; rows <= ROWS_MOST; rows++)
        {
            for (size_t n = 1; n <= SUMMED_MOST; n++)
            {
                check_sums(set_at(s), ROWS_OF_BYTES, rows, n);
                check_sums(set_at(s), ROWS_OF_SCALED, rows, n);
                check_sums(set_at(s), ROWS_OF_FLOATS, rows, n);
            }
        }
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {values_are_true,
                                  values_do_not_depend_on_the_place_in_an_array,
                                  bilinear_bytes_are_those_of_the_scalar_set,
                                  constants_stay,
                                  ramps_stay,
                                  arithmetic_adds_little_to_rounding,
                                  sums_of_rows_are_the_same_bits_in_all_sets,
                                  NULL};
    return run_suite("sample sets", tests);
}
