/* SPDX-License-Identifier: MIT
 *
 * Medians, their intervals and the U test against printed tables, other programs' figures, counting one by one, and what
 * chance makes; and how many calls make a sample.
 */
#include "tests/suite.h"

#include "bench/harness/harness.h"
#include "bench/harness/significance.h"

enum
{
    SAMPLES_MAX = 1001
};

static void shuffle(double *list, size_t count, uint64_t *state)
{
    for (size_t i = count; i > 1; i--)
    {
        const size_t j = next_bits(state) % i;
        const double kept = list[i - 1];
        list[i - 1] = list[j];
        list[j] = kept;
    }
}

/* The rank of the lower end, counted from 1; 0: there is none. Of 0.95 as in Conover's table A3 and Hollander and Wolfe's;
 * the others from the binomial distribution of SciPy 1.10. */
START_TEST(intervals)
{
    static const struct
    {
        size_t count;
        double confidence;
        size_t rank;
    } known[] = {{1, 0.95, 0},     {5, 0.95, 0},      {6, 0.95, 1},    {7, 0.95, 1},
                 {8, 0.95, 1},     {9, 0.95, 2},      {10, 0.95, 2},   {11, 0.95, 2},
                 {12, 0.95, 3},    {15, 0.95, 4},     {20, 0.95, 6},   {25, 0.95, 8},
                 {30, 0.95, 10},   {31, 0.95, 10},    {100, 0.95, 40}, {20, 0.99, 4},
                 {30, 0.99, 8},    {1001, 0.95, 470}, {1, 0.5, 0},     {2, 0.5, 1},
                 {1001, 0.99, 460}};
    uint64_t state = 3;
    for (size_t k = 0; k < sizeof known / sizeof *known; k++)
    {
        double samples[SAMPLES_MAX];
        const size_t n = known[k].count;
        for (size_t i = 0; i < n; i++)
        {
            samples[i] = (double)i + 1.0;
        }
        shuffle(samples, n, &state);
        const median_interval found = median_within(samples, n, known[k].confidence);
        ck_assert_double_eq(found.median, ((double)n + 1.0) / 2.0);
        if (known[k].rank == 0)
        {
            ck_assert_msg(isinf(found.low) && isinf(found.high), "%zu: %g", n, found.low);
            continue;
        }
        ck_assert_double_eq(found.low, (double)known[k].rank);
        ck_assert_double_eq(found.high, (double)(n + 1 - known[k].rank));
    }
}
END_TEST

START_TEST(summaries)
{
    const double even[] = {4.0, 1.0, 3.0, 2.0};
    const double odd[] = {9.0, 1.0, 5.0};
    ck_assert_double_eq(summary(even, 4).median, 2.5);
    ck_assert_double_eq(summary(even, 4).best, 1.0);
    ck_assert_double_eq(summary(even, 4).upper_quartile, 4.0);
    ck_assert_double_eq(summary(odd, 3).median, 5.0);
    ck_assert_double_eq(summary(odd, 1).median, 9.0);
}
END_TEST

/* Hollander and Wolfe's permeability of membranes, as in R's example of wilcox.test: one-sided 0.1272. */
START_TEST(printed_example)
{
    const double at_term[] = {0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46};
    const double before[] = {1.15, 0.88, 0.90, 0.74, 1.21};
    ck_assert_double_eq_tol(rank_sum_probability(at_term, 10, before, 5), 0.2544122544122544,
                            1e-15);
    ck_assert_double_eq_tol(rank_sum_probability(before, 5, at_term, 10), 0.2544122544122544,
                            1e-15);
}
END_TEST

static void sequence(double *list, size_t count, size_t step, size_t modulus, double first)
{
    for (size_t i = 0; i < count; i++)
    {
        list[i] = (double)(i * step % modulus) + first;
    }
}

/* mannwhitneyu of SciPy 1.10: exact where there are no more than EXACT_SAMPLES, else asymptotic. */
START_TEST(figures_of_scipy)
{
    static const struct
    {
        size_t count[2];
        size_t step[2];
        size_t modulus[2];
        double first[2];
        double probability;
    } known[] = {
        {{25, 18}, {37, 53}, {101, 97}, {0.0, 22.5}, 0.1187641268738631},
        {{30, 30}, {37, 53}, {101, 97}, {0.0, 12.5}, 0.2927910521948256},
        {{40, 35}, {37, 53}, {101, 97}, {0.0, 9.5}, 0.54849057686623},
        {{40, 50}, {7, 5}, {11, 13}, {0.0, 0.0}, 0.2279530178893331}, /* ties */
        {{31, 4}, {7, 5}, {11, 13}, {0.0, 3.0}, 0.3356678564651626},
    };
    for (size_t k = 0; k < sizeof known / sizeof *known; k++)
    {
        double list[2][64];
        for (int side = 0; side < 2; side++)
        {
            sequence(list[side], known[k].count[side], known[k].step[side], known[k].modulus[side],
                     known[k].first[side]);
        }
        ck_assert_double_eq_tol(
            rank_sum_probability(list[0], known[k].count[0], list[1], known[k].count[1]),
            known[k].probability, 1e-13);
    }
}
END_TEST

/* Twice the pairs in which the one that is chosen is the greater, ties counting half. */
static long pairs_won(const double *all, size_t count, unsigned chosen)
{
    long won = 0;
    for (size_t i = 0; i < count; i++)
    {
        for (size_t j = 0; j < count; j++)
        {
            if ((chosen >> i & 1u) != 0 && (chosen >> j & 1u) == 0)
            {
                won += (all[i] > all[j]) + (all[i] >= all[j]);
            }
        }
    }
    return won;
}

static unsigned bits_in(unsigned word)
{
    unsigned bits = 0;
    for (; word != 0; word &= word - 1)
    {
        bits++;
    }
    return bits;
}

/* By going through every choice of the first list from both, pair by pair, without ranks. */
static double counted_probability(const double *all, size_t one, size_t other)
{
    const size_t count = one + other;
    const long here = pairs_won(all, count, (1u << one) - 1u);
    unsigned long at_most = 0;
    unsigned long at_least = 0;
    unsigned long choices = 0;
    for (unsigned chosen = 0; chosen < 1u << count; chosen++)
    {
        if (bits_in(chosen) == one)
        {
            const long won = pairs_won(all, count, chosen);
            at_most += won <= here;
            at_least += won >= here;
            choices++;
        }
    }
    return fmin(1.0, 2.0 * (double)(at_most < at_least ? at_most : at_least) / (double)choices);
}

START_TEST(small_lists_one_by_one)
{
    uint64_t state = 11;
    for (size_t one = 1; one <= 5; one++)
    {
        for (size_t other = 1; other <= 5; other++)
        {
            /* of few values, so that there are ties, and of many */
            for (uint64_t values = 2; values <= 2048; values *= 4)
            {
                double all[10];
                for (size_t i = 0; i < one + other; i++)
                {
                    all[i] = (double)(next_bits(&state) % values) / 8.0;
                }
                ck_assert_double_eq_tol(rank_sum_probability(all, one, all + one, other),
                                        counted_probability(all, one, other), 1e-14);
            }
        }
    }
}
END_TEST

START_TEST(extremes)
{
    double low[40];
    double high[40];
    sequence(low, 40, 1, 40, 1.0);
    sequence(high, 40, 1, 40, 100.0);
    ck_assert_double_eq_tol(rank_sum_probability(low, 3, high, 3), 0.1, 1e-15);
    ck_assert_double_eq_tol(rank_sum_probability(low, 4, high, 4), 2.0 / 70.0, 1e-15);
    ck_assert_double_eq_tol(
        rank_sum_probability(low, 30, high, 30) / least_rank_sum_probability(30, 30), 1.0, 1e-11);
    ck_assert_double_lt(rank_sum_probability(low, 40, high, 40), 1e-13);
    ck_assert_double_eq(least_rank_sum_probability(1, 1), 1.0);
    ck_assert_double_eq_tol(least_rank_sum_probability(4, 4), 2.0 / 70.0, 1e-13);
    for (int i = 0; i < 40; i++)
    {
        low[i] = high[i] = 5.0;
    }
    ck_assert_double_eq(rank_sum_probability(low, 40, high, 40), 1.0);
    ck_assert_double_eq(rank_sum_probability(low, 7, high, 9), 1.0);
}
END_TEST

/* How often equal lists differ at alpha 0.05: at most so often, and of nine samples each in 0.0400 of all cases, which is
 * the greatest that nine have below it. */
START_TEST(false_alarms)
{
    static const struct
    {
        size_t count;
        double expected;
    } sizes[] = {{9, 0.0400}, {30, 0.0496}, {50, 0.05}};
    enum
    {
        TRIALS = 4000
    };
    uint64_t state = 29;
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
    {
        const size_t trials = TRIALS / (sizes[k].count == 30 ? step_of(8) : 1);
        size_t alarms = 0;
        for (size_t trial = 0; trial < trials; trial++)
        {
            double list[100];
            for (size_t i = 0; i < 2 * sizes[k].count; i++)
            {
                list[i] = exp(3.0 * next_real(&state)); /* far from normal */
            }
            alarms += rank_sum_probability(list, sizes[k].count, list + sizes[k].count,
                                           sizes[k].count) <= 0.05;
        }
        const double rate = (double)alarms / (double)trials;
        const double doubt = 4.0 * sqrt(0.05 * 0.95 / (double)trials);
        ck_assert_msg(fabs(rate - sizes[k].expected) < doubt, "%zu samples: %g", sizes[k].count,
                      rate);
    }
}
END_TEST

/* Whatever a call takes, a sample is of a thousand ticks or more, and not of many more. */
START_TEST(calls)
{
    const double tick = clock_tick();
    ck_assert_msg(tick > 0.0 && tick < 0.1, "%g s", tick);
    ck_assert_double_eq(clock_tick(), tick);
    for (double each = 1e-5 * tick; each < 1e6 * tick; each *= 7.0)
    {
        size_t count = 0;
        int rounds = 0;
        for (size_t next = 1; next != count; rounds++)
        {
            count = next;
            next = calls_for_sample(count, (double)count * each);
        }
        const double took = (double)count * each;
        ck_assert_msg(took >= 1000.0 * tick && (count == 1 || took <= 1200.0 * tick + 2.0 * each),
                      "%g ticks", took / tick);
        ck_assert_int_lt(rounds, 13);
    }
    ck_assert_uint_gt(calls_for_sample(1, 0.0), 100);
    ck_assert_uint_eq(calls_for_sample(1, 999.99 * tick), 2);
}
END_TEST

/* Seconds of calls that take a tick each, but for the first, which something interrupts. */
static double interrupted(void *user, size_t count)
{
    int *times = user;
    return clock_tick() * ((double)count + ((*times)++ == 0 ? 5000.0 : 0.0));
}

START_TEST(interruptions)
{
    int times = 0;
    const size_t count = calls_a_sample(interrupted, &times);
    ck_assert_msg(count >= 1000 && count < 1200, "%zu calls", count);
}
END_TEST

START_TEST(dates)
{
    char text[DATE_SIZE];
    int number[6];
    char end;
    date_now(text);
    ck_assert_int_eq(sscanf(text, "%4d-%2d-%2dT%2d:%2d:%2d%c", &number[0], &number[1], &number[2],
                            &number[3], &number[4], &number[5], &end),
                     7);
    ck_assert_int_eq(end, 'Z');
    ck_assert_uint_eq(strlen(text), 20);
    ck_assert_int_ge(number[0], 2024);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {intervals,
                                  summaries,
                                  printed_example,
                                  figures_of_scipy,
                                  extremes,
                                  small_lists_one_by_one,
                                  false_alarms,
                                  calls,
                                  interruptions,
                                  dates,
                                  NULL};
    return run_suite("significance", tests);
}
