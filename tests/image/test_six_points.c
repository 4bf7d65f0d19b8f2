/* SPDX-License-Identifier: MIT
 *
 * Values between six pixels each way, and bytes that come apart: the loops of every instruction set have the same bits,
 * which are within rounding of sums in double.
 */
#include "tests/suite.h"

#include "modules/image/filter_set.h"

#include <cubemap/options.h>

enum
{
    EXTENT = 40,
    NUMBERS = EXTENT * 5 + 64, /* of a row, with what loops read behind */
    CHANNEL = EXTENT + 16,     /* of channels that are apart */
    GUARD = 4242
};

static uint32_t random_state = 9;

static uint32_t random_bits(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    return random_state >> 8;
}

static uint8_t bytes[EXTENT][NUMBERS];
static int16_t words[EXTENT][NUMBERS];
static float floats[EXTENT][NUMBERS];

static void fill(void)
{
    for (size_t row = 0; row < EXTENT; row++)
    {
        for (size_t i = 0; i < NUMBERS; i++)
        {
            bytes[row][i] = (uint8_t)random_bits();
            words[row][i] = (int16_t)((int)(random_bits() % 65536) - 32768);
            floats[row][i] = (float)(random_bits() % 65536) / 65536.0f;
        }
    }
}

/* Between pixels, on some, at both ends, and before and behind all of them. */
static void place(size_t n, double *position)
{
    static const double hard[] = {0.5,
                                  0.0,
                                  0.499999999999,
                                  0.25,
                                  EXTENT - 0.5,
                                  EXTENT - 0.01,
                                  EXTENT - 0.5000001,
                                  3.5,
                                  3.5 + 1e-12,
                                  3.0};
    for (size_t i = 0; i < n; i++)
    {
        position[i] = i < sizeof hard / sizeof *hard
                          ? hard[i]
                          : (double)(random_bits() % 100000) / 100000.0 * EXTENT;
    }
}

/* The value of Lagrange's polynomial, or of the line through the nearest two. */
static void true_weights(double position, int is_cautious, int32_t first, double weight[CM_SIX])
{
    const double at = position - 0.5 - first;
    const int is_line = is_cautious && (at < 0.0 || at > CM_SIX - 1.0);
    for (int k = 0; k < CM_SIX; k++)
    {
        weight[k] = is_line ? 0.0 : 1.0;
        for (int other = 0; !is_line && other < CM_SIX; other++)
        {
            weight[k] *= other == k ? 1.0 : (at - other) / (k - other);
        }
    }
    if (is_line)
    {
        const int low = at < 0.0 ? 0 : CM_SIX - 2;
        weight[low] = low + 1 - at;
        weight[low + 1] = at - low;
    }
}

static void check_points(const cm_filter_set *set, const cm_filter_set *plain, size_t n,
                         int is_cautious, const double *position, cm_six_points *points)
{
    cm_six_points other;
    set->six_points(n, position, EXTENT, is_cautious, points);
    plain->six_points(n, position, EXTENT, is_cautious, &other);
    for (size_t i = 0; i < n; i++)
    {
        double weight[CM_SIX];
        ck_assert(points->first[i] >= 0 && points->first[i] <= EXTENT - CM_SIX);
        ck_assert_int_eq(points->first[i], other.first[i]);
        true_weights(position[i], is_cautious, points->first[i], weight);
        for (int k = 0; k < CM_SIX; k++)
        {
            const float is = points->weight[k][i];
            ck_assert(memcmp(&is, &other.weight[k][i], sizeof is) == 0);
            ck_assert_msg(fabs((double)is - weight[k]) < 1e-6, "%s %g: weight %d is %g, not %g",
                          set->name, position[i], k, (double)is, weight[k]);
            ck_assert(!points->exact[i] || is == 0.0f || is == 1.0f);
        }
    }
}

/* What a place's number is, by the weights as they are. */
static double true_sum(const cm_six_points *across, const cm_six_points *along, size_t i,
                       size_t step, size_t first, double scale,
                       double (*number)(size_t row, size_t at))
{
    double sum = 0.0;
    for (size_t j = 0; j < CM_SIX; j++)
    {
        for (size_t k = 0; k < CM_SIX; k++)
        {
            sum +=
                (double)along->weight[j][i] * (double)across->weight[k][i] * scale *
                number((size_t)along->first[i] + j, ((size_t)across->first[i] + k) * step + first);
        }
    }
    return sum;
}

static double byte_at(size_t row, size_t at)
{
    return bytes[row][at];
}

static double word_at(size_t row, size_t at)
{
    return words[row][at];
}

static double float_at(size_t row, size_t at)
{
    return (double)floats[row][at];
}

/* One of the loops, beside that of the plain set and the truth. */
typedef struct loop
{
    const char *name;
    int is_apart;
    size_t size; /* of a number */
    double scale;
    double most; /* of values */
    double (*number)(size_t row, size_t at);
} loop;

static const loop loops[] = {{"bytes", 0, 1, 1.0 / 255.0, 1.0, byte_at},
                             {"floats", 0, sizeof(float), 1.0, 1.0, float_at},
                             {"words", 1, sizeof(int16_t), 1.0, 32768.0, word_at},
                             {"lines", 1, sizeof(float), 1.0, 1.0, float_at}};

static const char *memory_of(const loop *of)
{
    return of->number == byte_at   ? (const char *)bytes
           : of->number == word_at ? (const char *)words
                                   : (const char *)floats;
}

static void run(const cm_filter_set *set, const loop *of, size_t channels, size_t n,
                const cm_six_points *across, const cm_six_points *along, float *to)
{
    const void *from[CM_SIX_MOST];
    const ptrdiff_t size = (ptrdiff_t)of->size, row = NUMBERS * size;
    const ptrdiff_t step = of->is_apart ? size : size * (ptrdiff_t)channels;
    for (size_t i = 0; i < n; i++)
    {
        from[i] = memory_of(of) + along->first[i] * row + across->first[i] * step;
    }
    if (of->is_apart)
    {
        (of->number == word_at ? set->six_words : set->six_lines)(
            channels, n, from, row, CHANNEL * size, across, along, to);
        return;
    }
    (of->number == byte_at ? set->six_bytes : set->six_floats)(channels, n, from, row,
                                                               (float)of->scale, across, along, to);
}

static void check_loop(const cm_filter_set *set, const cm_filter_set *plain, const loop *of,
                       size_t channels, size_t n)
{
    double x[CM_SIX_MOST], y[CM_SIX_MOST];
    cm_six_points across, along;
    float is[CM_SIX_CHANNELS * CM_SIX_MOST + 1], other[CM_SIX_CHANNELS * CM_SIX_MOST];
    place(n, x);
    place(n, y);
    check_points(set, plain, n, of->number == byte_at, x, &across);
    check_points(set, plain, n, of->number == byte_at, y, &along);
    is[CM_SIX_CHANNELS * CM_SIX_MOST] = GUARD;
    run(set, of, channels, n, &across, &along, is);
    run(plain, of, channels, n, &across, &along, other);
    ck_assert(is[CM_SIX_CHANNELS * CM_SIX_MOST] == GUARD);
    for (size_t i = 0; i < n; i++)
    {
        for (size_t c = 0; c < channels; c++)
        {
            const size_t at = of->is_apart ? c * CM_SIX_MOST + i : i * CM_SIX_CHANNELS + c;
            const double wanted = true_sum(&across, &along, i, of->is_apart ? 1 : channels,
                                           of->is_apart ? c * CHANNEL : c, of->scale, of->number);
            ck_assert_msg(memcmp(&is[at], &other[at], sizeof *is) == 0, "%s, %s: %.9g, not %.9g",
                          set->name, of->name, (double)is[at], (double)other[at]);
            /* weights beyond the last pixel add up to 22 at most, each way */
            ck_assert_msg(fabs((double)is[at] - wanted) <= 1e-5 * of->most, "%s, %s: %g, not %g",
                          set->name, of->name, (double)is[at], wanted);
        }
    }
}

START_TEST(all_sets_have_the_same_values_between_pixels)
{
    const cm_filter_set *plain = cm_filter_set_find("scalar");
    fill();
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const cm_filter_set *set = cm_filter_set_find(cm_instructions_at(s));
        for (size_t k = 0; k < sizeof loops / sizeof *loops; k++)
        {
            for (size_t channels = 1; channels <= CM_SIX_CHANNELS; channels++)
            {
                for (size_t n = 1; n <= CM_SIX_MOST; n += n < 20 ? 1 : 11)
                {
                    check_loop(set, plain, &loops[k], channels, n);
                }
            }
        }
    }
}
END_TEST

START_TEST(bytes_come_apart)
{
    float to[5 * EXTENT + 1];
    fill();
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const cm_filter_set *set = cm_filter_set_find(cm_instructions_at(s));
        for (size_t channels = 1; channels <= 5; channels++)
        {
            for (size_t n = 1; n <= EXTENT; n++)
            {
                /* the last byte is the last that there is */
                const uint8_t *from = &bytes[EXTENT - 1][NUMBERS] - n * channels;
                to[channels * n] = GUARD;
                set->part_bytes(from, channels, n, 1.0f / 255.0f, to, (ptrdiff_t)n);
                for (size_t i = 0; i < n * channels; i++)
                {
                    const float wanted = (float)from[i % n * channels + i / n] * (1.0f / 255.0f);
                    ck_assert(memcmp(&to[i], &wanted, sizeof wanted) == 0);
                }
                ck_assert(to[channels * n] == GUARD);
            }
        }
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {all_sets_have_the_same_values_between_pixels, bytes_come_apart,
                                  NULL};
    return run_suite("six points", tests);
}
