/* SPDX-License-Identifier: MIT
 *
 * Levels of whole numbers: the loops of every instruction set have the same bits, which are those of sums in 64 bits.
 */
#include "tests/suite.h"

#include "modules/image/filter_set.h"

#include <cubemap/options.h>

enum
{
    MOST = 600, /* new pixels of a row */
    CHANNELS_MOST = 5,
    ROWS = CM_EIGHTHS_ROWS + CM_ROWS_NEXT,
    OLD = 3 * MOST + 2 * CM_TAPS_MOST,
    GUARD = 4242
};

static uint32_t random_state = 5;

static uint32_t random_bits(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    return random_state >> 8;
}

/* Few are small: sums go beyond what 16 bits have. */
static int16_t random_word(void)
{
    const uint32_t bits = random_bits();
    return (int16_t)(bits % 4 == 0 ? 32767 : bits % 4 == 1 ? -32768 : (int)(bits % 65536) - 32768);
}

/* Weights whose absolute values are no more than twice CM_HALF_ONE in all. */
static void random_weights(int16_t *weight, int count)
{
    const int most = 2 * CM_HALF_ONE / count;
    for (int k = 0; k < count; k++)
    {
        weight[k] = (int16_t)((int)(random_bits() % (2u * (unsigned)most)) - most);
    }
}

static int16_t rounded(int64_t sum, int bits)
{
    const int64_t value = (sum + (1 << (bits - 1))) >> bits;
    return (int16_t)(value > 32767 ? 32767 : value < -32768 ? -32768 : value);
}

static int16_t words[ROWS][OLD];
static uint8_t bytes[ROWS][OLD];

static void fill(void)
{
    for (size_t k = 0; k < ROWS; k++)
    {
        for (size_t i = 0; i < OLD; i++)
        {
            words[k][i] = random_word();
            bytes[k][i] = (uint8_t)(random_bits() % 3 == 0 ? 255 : random_bits() % 256);
        }
    }
}

static int64_t sum_of_rows(const int16_t *weight, int count, int first, size_t i)
{
    int64_t sum = 0;
    for (int k = 0; k < count; k++)
    {
        sum += (int64_t)weight[k] * words[first + k][i];
    }
    return sum;
}

static void check_rows(const cm_filter_set *set, size_t n)
{
    int16_t weight[CM_HALF_TAPS], one[MOST + 1], two[MOST + 1], below[MOST + 1], byte[MOST + 1];
    const int16_t *rows[ROWS];
    const uint8_t *byte_rows[ROWS];
    random_weights(weight, CM_HALF_TAPS);
    for (size_t k = 0; k < ROWS; k++)
    {
        rows[k] = words[k];
        byte_rows[k] = bytes[k];
    }
    one[n] = two[n] = below[n] = byte[n] = GUARD;
    set->mix_whole(rows, weight, CM_HALF_EVEN, n, one);
    set->mix_two_whole(rows, weight, n, two, below);
    set->mix_bytes(byte_rows, weight, n, byte);
    for (size_t i = 0; i < n; i++)
    {
        int64_t sum = 0;
        for (int k = 0; k < CM_HALF_TAPS / 2; k++)
        {
            sum += (int64_t)weight[k] * (bytes[k][i] + bytes[CM_HALF_TAPS - 1 - k][i]);
        }
        ck_assert_int_eq(one[i], rounded(sum_of_rows(weight, CM_HALF_TAPS, 0, i), CM_HALF_BITS));
        ck_assert_int_eq(two[i], one[i]);
        ck_assert_int_eq(below[i], rounded(sum_of_rows(weight, CM_HALF_TAPS, 2, i), CM_HALF_BITS));
        ck_assert_int_eq(byte[i], rounded(sum, CM_HALF_BYTE_BITS));
    }
    ck_assert(one[n] == GUARD && two[n] == GUARD && below[n] == GUARD && byte[n] == GUARD);
}

static void check_eighths(const cm_filter_set *set, size_t n)
{
    int16_t weight[3][CM_EIGHTHS_TAPS], one[MOST + 1], three[3][MOST + 1];
    const int16_t(*const same)[CM_EIGHTHS_TAPS] = (const int16_t(*)[CM_EIGHTHS_TAPS])weight;
    int16_t *const to[3] = {three[0], three[1], three[2]};
    const int16_t *rows[ROWS];
    const uint8_t *byte_rows[ROWS];
    for (size_t k = 0; k < ROWS; k++)
    {
        rows[k] = words[k];
        byte_rows[k] = bytes[k];
    }
    for (int third = 0; third < 3; third++)
    {
        random_weights(weight[third], CM_EIGHTHS_TAPS);
        three[third][n] = GUARD;
    }
    one[n] = GUARD;
    set->mix_whole(rows, weight[0], CM_EIGHTHS_ODD, n, one);
    set->mix_bytes_eighths(byte_rows, same, n, to);
    for (size_t i = 0; i < n; i++)
    {
        ck_assert_int_eq(one[i],
                         rounded(sum_of_rows(weight[0], CM_EIGHTHS_TAPS, 0, i), CM_HALF_BITS));
        for (int third = 0; third < 3; third++)
        {
            int64_t sum = 0;
            for (int k = 0; k < CM_EIGHTHS_TAPS; k++)
            {
                sum += (int64_t)weight[third][k] * bytes[3 * third + k][i];
            }
            ck_assert_int_eq(three[third][i], rounded(sum, CM_HALF_BYTE_BITS));
        }
    }
    ck_assert(one[n] == GUARD && three[0][n] == GUARD && three[1][n] == GUARD &&
              three[2][n] == GUARD);
}

/* The taps of new pixels as cm_half_steps has them. */
static void make_taps(cm_half_steps steps, size_t n, cm_half_taps *taps)
{
    const size_t period = steps == CM_HALF_EVEN ? 1 : steps == CM_EIGHTHS_EVEN ? 3 : n;
    for (size_t i = 0; i < n; i++)
    {
        const int are_eighths = cm_half_count(steps) == CM_EIGHTHS_TAPS;
        taps[i].first = (int32_t)(are_eighths ? (16 * i + 5) / 6 : 2 * i) + 7;
        if (i < period)
        {
            random_weights(taps[i].whole, cm_half_count(steps));
        }
        else
        {
            memcpy(taps[i].whole, taps[i - period].whole, sizeof taps[i].whole);
        }
    }
}

static void check_columns(const cm_filter_set *set, size_t n, cm_half_steps steps)
{
    cm_half_taps taps[MOST] = {{0}};
    int16_t to[MOST + 1];
    make_taps(steps, n, taps);
    to[n] = GUARD;
    set->halve_row_whole(words[0], taps, steps, n, to);
    for (size_t i = 0; i < n; i++)
    {
        int64_t sum = 0;
        for (int k = 0; k < cm_half_count(steps); k++)
        {
            sum += (int64_t)taps[i].whole[k] * words[0][taps[i].first - taps[0].first + 1 + k];
        }
        ck_assert_int_eq(to[i], rounded(sum, CM_HALF_BITS));
    }
    ck_assert_int_eq(to[n], GUARD);
}

static void check_parts(const cm_filter_set *set, size_t n, size_t channels)
{
    int16_t to[CHANNELS_MOST * MOST + 1];
    int16_t of_bytes[MOST + 1];
    const int16_t *from = &words[0][0];
    to[channels * n] = of_bytes[n] = GUARD;
    set->part_whole(from, channels, n, to, (ptrdiff_t)n);
    set->whole_of_bytes(n, bytes[0], of_bytes);
    for (size_t i = 0; i < n; i++)
    {
        for (size_t c = 0; c < channels; c++)
        {
            ck_assert_int_eq(to[c * n + i], from[i * channels + c]);
        }
        ck_assert(fabs(of_bytes[i] - bytes[0][i] * 16384.0 / 255.0) <= 0.75);
    }
    ck_assert(to[channels * n] == GUARD && of_bytes[n] == GUARD);
}

START_TEST(all_sets_have_the_same_whole_numbers)
{
    fill();
    for (size_t s = 0; s < cm_instructions_count(); s++)
    {
        const char *name = cm_instructions_at(s);
        const cm_filter_set *set = cm_filter_set_find(name);
        ck_assert_str_eq(set->name, name);
        for (size_t n = 1; n <= MOST; n += n < 60 ? 1 : 17)
        {
            check_rows(set, n);
            check_eighths(set, n);
            check_columns(set, n, CM_HALF_EVEN);
            check_columns(set, n, CM_EIGHTHS_EVEN);
            check_columns(set, n, CM_EIGHTHS_ODD);
            check_columns(set, n, CM_HALF_ODD);
            for (size_t channels = 1; channels <= CHANNELS_MOST; channels++)
            {
                check_parts(set, n, channels);
            }
        }
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {all_sets_have_the_same_whole_numbers, NULL};
    return run_suite("halving", tests);
}
