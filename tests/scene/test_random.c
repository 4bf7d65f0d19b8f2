/* SPDX-License-Identifier: MIT
 *
 * Counted random numbers: the published vectors, the same bits everywhere, and distributions by Pearson's test at fixed
 * seeds.
 */
#define _POSIX_C_SOURCE 200809L
#include <cubemap/options.h>
#include <cubemap/random.h>

#include <float.h>

#define CM_SET_IS_SCALAR 1
#include "modules/scene/random_lanes.inc"

#include "modules/scene/exact_logarithm.inc"
#include "modules/scene/random_set.h"

#include "modules/scene/philox.inc"
#include "tests/instructions_variable.h"
#include "tests/suite.h"

#define BINS_MOST 128

/* Of the authors' file kat_vectors (Random123): counter, key, result. */
START_TEST(published_vectors)
{
    static const uint32_t vectors[3][10] = {
        {0, 0, 0, 0, 0, 0, 0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8},
        {0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff, 0x408f276d,
         0x41c83b0e, 0xa20bc7c6, 0x6d5451fd},
        {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344, 0xa4093822, 0x299f31d0, 0xd16cfe09,
         0x94fdcceb, 0x5001e420, 0x24126ea1}};
    for (int i = 0; i < 3; i++)
    {
        const uint32_t *v = vectors[i];
        uint32_t words[4];
        cm_random_block(v[4] | (uint64_t)v[5] << 32, v[2], v[0], v[1], v[3], words);
        REQUIRE(memcmp(words, v + 6, sizeof words) == 0, "%d: %08x %08x %08x %08x", i,
                (unsigned)words[0], (unsigned)words[1], (unsigned)words[2], (unsigned)words[3]);
    }
}
END_TEST

static uint64_t add_bits(uint64_t hash, double value) /* FNV-1a */
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; i++)
    {
        hash = (hash ^ (bits >> (8 * i) & 0xff)) * 0x100000001b3;
    }
    return hash;
}

static double mean_of(uint32_t pixel) /* from 0 to 1e9, on both sides of 10 */
{
    return (double)pixel * 0.37 * (pixel % 3 == 0 ? 1e4 : 0.01);
}

/* Whatever compiler, instruction set and C library. */
START_TEST(same_bits_everywhere)
{
    uint64_t hash[3] = {0xcbf29ce484222325, 0xcbf29ce484222325, 0xcbf29ce484222325};
    for (uint32_t i = 0; i < 20000; i++)
    {
        hash[0] = add_bits(hash[0], cm_random_uniform(20, i % 7, i, i % 5));
        hash[1] = add_bits(hash[1], cm_random_normal(20, i % 7, i, i % 5));
        hash[2] = add_bits(hash[2], cm_random_poisson(20, i % 7, i, i % 5, mean_of(i)));
    }
    REQUIRE(hash[0] == 0x0045bd6fa2b5ab31 && hash[1] == 0xfd42ae5ff27190bb &&
                hash[2] == 0x115abfca05157b43,
            "0x%016llx 0x%016llx 0x%016llx", (unsigned long long)hash[0],
            (unsigned long long)hash[1], (unsigned long long)hash[2]);
}
END_TEST

START_TEST(logarithm_and_exponential)
{
    double worst = 0.0;
    for (int i = -60000; i <= 60000; i++)
    {
        const double x = exp2(i * 0.017);
        if (x > 1e-308 && x < 1e308)
        {
            const double truth = log(x);
            worst = fmax(worst, fabs(exact_log(x) - truth) / (fabs(truth) + DBL_MIN));
        }
    }
    REQUIRE(worst <= 4.0 * DBL_EPSILON && exact_log(1.0) == 0.0, "log: %g eps",
            worst / DBL_EPSILON);
    for (double x = 1.0 - 1e-3; x < 1.0 + 1e-3; x += 1.7e-6)
    {
        REQUIRE(fabs(exact_log(x) - log(x)) <= 2.0 * DBL_EPSILON * fabs(log(x)), "%.17g", x);
    }
    for (double x = -30.0; x <= 0.0; x += 0.00137)
    {
        REQUIRE(fabs(exact_exp(x) / exp(x) - 1.0) <= 4.0 * DBL_EPSILON, "exp %.17g", x);
    }
}
END_TEST

/* ---- Distributions ---- */

/* Is Pearson's sum so great that chance makes it so once in 30,000 times? (Wilson and Hilferty 1931) */
static int is_unlikely(double sum, double freedom)
{
    const double spread = 2.0 / (9.0 * freedom);
    return (cbrt(sum / freedom) - (1.0 - spread)) / sqrt(spread) > 4.0;
}

START_TEST(uniform_numbers)
{
    enum
    {
        COUNT = 400000,
        BINS = 100
    };
    static double value[COUNT];
    size_t in[BINS][BINS] = {{0}};
    double sum = 0.0;
    cm_random_uniform_array(5, 1, 0, 0, COUNT, value);
    for (size_t i = 0; i < COUNT; i += 2) /* pairs of neighbours */
    {
        ck_assert(value[i] > 0.0 && value[i] < 1.0);
        in[(int)(value[i] * BINS)][(int)(value[i + 1] * BINS)]++;
    }
    const double expected = COUNT / 2.0 / (BINS * BINS);
    for (int i = 0; i < BINS * BINS; i++)
    {
        const double off = (double)in[i / BINS][i % BINS] - expected;
        sum += off * off / expected;
    }
    REQUIRE(!is_unlikely(sum, BINS * BINS - 1), "%g", sum);
    ck_assert(fraction_of(0, 0) == 0x1p-53);
    ck_assert(fraction_of(0xffffffff, 0xffffffff) == 1.0 - 0x1p-53);
}
END_TEST

/* The distribution function brings back the uniform number that each is made of. */
START_TEST(normal_numbers)
{
    enum
    {
        COUNT = 200000,
        BINS = 100
    };
    size_t in[BINS] = {0};
    double sum = 0.0;
    for (uint32_t i = 0; i < COUNT; i++)
    {
        uint32_t words[4];
        cm_random_block(9, 2, i, 3, (uint32_t)2 << 28, words);
        const double u = fraction_of(words[0], words[1]);
        const double x = cm_random_normal(9, 2, i, 3);
        const double tail = fmin(u, 1.0 - u);
        const double back = 0.5 * erfc(fabs(x) / sqrt(2.0));
        REQUIRE(fabs(back - tail) <= 1e-15 * (4.0 + x * x) * tail, "%.17g: %.17g, off %g", u, x,
                back / tail - 1.0);
        ck_assert((u < 0.5) == (x < 0.0));
        in[(int)(0.5 * erfc(-x / sqrt(2.0)) * BINS)]++;
    }
    for (int i = 0; i < BINS; i++)
    {
        const double off = (double)in[i] - (double)COUNT / BINS;
        sum += off * off / ((double)COUNT / BINS);
    }
    REQUIRE(!is_unlikely(sum, BINS - 1), "%g", sum);
}
END_TEST

/* log of the probability, by the C library's logarithm of the gamma function in more digits than double has. */
static double probability(double k, double mean)
{
    return (double)expl((long double)k * logl((long double)mean) - (long double)mean -
                        lgammal((long double)k + 1.0L));
}

/* Whole counts in bins of a 64th or more each; 0 if they are not as the distribution has them. */
static double poisson_sum(double mean, size_t count, double *freedom)
{
    double sum = 0.0;
    double covered = 0.0;
    double share = 0.0;
    size_t in = 0;
    double total = 0.0;
    const double first = floor(fmax(0.0, mean - 12.0 * sqrt(mean)));
    const size_t width = (size_t)(24.0 * sqrt(mean)) + 40;
    size_t *seen = calloc(width, sizeof *seen);
    ck_assert_ptr_nonnull(seen);
    for (uint32_t i = 0; i < count; i++)
    {
        const double k = cm_random_poisson(77, 0, i, 0, mean);
        REQUIRE(k >= first && k < first + (double)width && k == floor(k), "mean %g: %g", mean, k);
        seen[(size_t)(k - first)]++;
        total += k;
    }
    *freedom = -1.0;
    for (size_t i = 0; i < width; i++)
    {
        share += probability(first + (double)i, mean);
        in += seen[i];
        const int is_rest = 1.0 - covered - share < 0.001;
        if (share >= 1.0 / 64.0 && !is_rest)
        {
            const double off = (double)in - share * (double)count;
            sum += off * off / (share * (double)count);
            covered += share;
            *freedom += 1.0;
            share = 0.0;
            in = 0;
        }
    }
    const double rest = (1.0 - covered) * (double)count;
    sum += ((double)in - rest) * ((double)in - rest) / rest;
    *freedom += 1.0;
    REQUIRE(fabs(total / (double)count - mean) <= 4.5 * sqrt(mean / (double)count), "mean %g: %g",
            mean, total / (double)count);
    free(seen);
    return sum;
}

START_TEST(poisson_numbers)
{
    static const double means[] = {0.1,  0.5,  1.0,   3.0,   7.0, 9.99, 10.0, 10.5,
                                   15.0, 30.0, 100.0, 316.0, 1e3, 1e4,  1e5,  1e6};
    const size_t count = is_quick() ? 50000 : 400000;
    for (size_t i = 0; i < sizeof means / sizeof *means; i++)
    {
        double freedom;
        const double sum = poisson_sum(means[i], count, &freedom);
        REQUIRE(!is_unlikely(sum, fmax(1.0, freedom)), "mean %g: %g with %g of freedom", means[i],
                sum, freedom);
    }
}
END_TEST

/* Where a variance is as the mean, far beyond what a table could hold. */
START_TEST(great_means)
{
    enum
    {
        COUNT = 20000
    };
    static const double means[] = {1e8, 1e12, 1e15};
    for (size_t i = 0; i < sizeof means / sizeof *means; i++)
    {
        double sum = 0.0;
        double squares = 0.0;
        for (uint32_t k = 0; k < COUNT; k++)
        {
            const double off =
                (cm_random_poisson(3, 0, k, 0, means[i]) - means[i]) / sqrt(means[i]);
            sum += off;
            squares += off * off;
        }
        REQUIRE(fabs(sum) <= 4.5 * sqrt(COUNT), "mean %g: %g", means[i], sum / COUNT);
        REQUIRE(fabs(squares - COUNT) <= 4.5 * sqrt(2.0 * COUNT), "mean %g: variance %g", means[i],
                squares / COUNT);
    }
    ck_assert(cm_random_poisson(3, 0, 0, 0, 1e40) == 1e40);
    ck_assert(isfinite(cm_random_poisson(3, 0, 0, 0, DBL_MAX)));
    ck_assert(cm_random_poisson(3, 0, 0, 0, 0.0) == 0.0);
    ck_assert(cm_random_poisson(3, 0, 0, 0, 5e-324) == 0.0);
    ck_assert(isnan(cm_random_poisson(3, 0, 0, 0, -1e-300)));
    ck_assert(isnan(cm_random_poisson(3, 0, 0, 0, (double)NAN)));
    ck_assert(isnan(cm_random_poisson(3, 0, 0, 0, (double)INFINITY)));
}
END_TEST

/* Arrays in parts, over the end of the pixels, and in place. */
START_TEST(arrays)
{
    enum
    {
        COUNT = 1000
    };
    double value[COUNT];
    double mean[COUNT];
    const uint32_t first = 0xffffffff - 500;
    for (uint32_t i = 0; i < COUNT; i++)
    {
        mean[i] = mean_of(i);
    }
    cm_random_normal_array(1, 2, first, 3, COUNT, value);
    for (uint32_t i = 0; i < COUNT; i++)
    {
        ck_assert(value[i] == cm_random_normal(1, 2, first + i, 3));
    }
    cm_random_uniform_array(1, 2, first, 3, 300, value);
    cm_random_uniform_array(1, 2, first + 300, 3, COUNT - 300, value + 300);
    for (uint32_t i = 0; i < COUNT; i++)
    {
        ck_assert(value[i] == cm_random_uniform(1, 2, first + i, 3));
    }
    cm_random_poisson_array(1, 2, first, 3, COUNT, mean, value);
    cm_random_poisson_array(1, 2, first, 3, COUNT, mean, mean);
    ck_assert(memcmp(mean, value, sizeof mean) == 0);
    ck_assert(value[900] == cm_random_poisson(1, 2, first + 900, 3, mean_of(900)));
    cm_random_poisson_array(1, 2, first, 3, 0, NULL, NULL);
}
END_TEST

/* Means of all kinds, many and few of each beside one another: invalid ones, 0, around 10, around 16, and so great that no
 * whole number is left out. */
static double rough_mean(uint32_t i)
{
    static const double special[] = {0.0,  5e-324,          1e-20,          9.999999999999998,
                                     10.0, 10.000000000001, 1e300,          (double)INFINITY,
                                     -1.0, (double)NAN,     0x1.8p52 + 1.0, DBL_MAX};
    const double u = cm_random_uniform(4, 0, i, 0);
    switch (i / 37 % 6)
    {
    case 0:
        return special[i % (sizeof special / sizeof *special)];
    case 1:
        return 10.0 * u;
    case 2:
        return 8.0 + 20.0 * u;
    case 3:
        return 1000.0 * u;
    case 4:
        return exp2(70.0 * u);
    default:
        return i % 2 == 0 ? 3.0 : 3000.0;
    }
}

enum
{
    SET_NUMBERS = 4000
};

static void check_same_bits(const char *set, const char *what, const double *value,
                            const double *alone, size_t n)
{
    for (size_t i = 0; i < n; i++)
    {
        REQUIRE(memcmp(value + i, alone + i, sizeof *value) == 0 ||
                    (isnan(value[i]) && isnan(alone[i])),
                "%s, %s %zu of %zu: %.17g, alone %.17g", set, what, i, n, value[i], alone[i]);
    }
    ck_assert(value[n] == -7.0); /* and nothing behind */
}

static void check_set(const char *set, size_t n)
{
    static double alone[3][SET_NUMBERS];
    static double value[3][SET_NUMBERS + 1];
    static double mean[SET_NUMBERS];
    const uint64_t seed = 0xfedcba9876543210;
    const uint32_t first = UINT32_MAX - (uint32_t)n / 2;
    for (uint32_t i = 0; i < n; i++)
    {
        mean[i] = rough_mean(i + (uint32_t)n);
        alone[0][i] = cm_random_uniform(seed, 0x80000000, first + i, 0xffffffff);
        alone[1][i] = cm_random_normal(seed, 0x80000000, first + i, 0xffffffff);
        alone[2][i] = cm_random_poisson(seed, 0x80000000, first + i, 0xffffffff, mean[i]);
    }
    for (int k = 0; k < 3; k++)
    {
        value[k][n] = -7.0;
    }
    set_instructions_variable(set);
    cm_random_uniform_array(seed, 0x80000000, first, 0xffffffff, n, value[0]);
    cm_random_normal_array(seed, 0x80000000, first, 0xffffffff, n, value[1]);
    cm_random_poisson_array(seed, 0x80000000, first, 0xffffffff, n, mean, value[2]);
    set_instructions_variable(NULL);
    check_same_bits(set, "uniform", value[0], alone[0], n);
    check_same_bits(set, "normal", value[1], alone[1], n);
    check_same_bits(set, "Poisson", value[2], alone[2], n);
}

/* Numbers of arrays are those that are made alone, by every set, in every length; and a name that is no set's does no harm. */
START_TEST(instruction_sets)
{
    const char *const before = getenv("CUBEMAP_INSTRUCTIONS");
    char *const kept = before == NULL ? NULL : strdup(before);
    for (size_t k = 0; k <= cm_instructions_count(); k++)
    {
        const char *set = k < cm_instructions_count() ? cm_instructions_at(k) : "abacus";
        for (size_t n = 0; n < 300; n += n < 30 ? 1 : 17)
        {
            check_set(set, n);
        }
        check_set(set, SET_NUMBERS);
    }
    set_instructions_variable(kept);
    free(kept);
}
END_TEST

START_TEST(whole_numbers)
{
    for (double x = -3.0; x <= 3.0; x += 0.125)
    {
        ck_assert(floor_of(x) == floor(x));
        ck_assert(floor_of(x * 0x1p49 + 0.25) == floor(x * 0x1p49 + 0.25));
        ck_assert(floor_of(x * 0x1p51) == floor(x * 0x1p51));
        ck_assert(floor_of(x * 0x1p60) == x * 0x1p60);
    }
    ck_assert(floor_of(-0x1p-1074) == -1.0 && floor_of(0x1p-1074) == 0.0);
    ck_assert(floor_of(1.0 - 0x1p-53) == 0.0 && floor_of(DBL_MAX) == DBL_MAX);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {published_vectors,
                                  same_bits_everywhere,
                                  logarithm_and_exponential,
                                  uniform_numbers,
                                  normal_numbers,
                                  poisson_numbers,
                                  great_means,
                                  arrays,
                                  instruction_sets,
                                  whole_numbers,
                                  NULL};
    return run_suite("random", tests);
}
