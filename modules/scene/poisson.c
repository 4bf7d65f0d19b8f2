/* SPDX-License-Identifier: MIT
 *
 * Counts of Poisson's distribution.
 */
#include <cubemap/random.h>

#include <math.h>

#include "exact_logarithm.h"

#define POISSON_BLOCKS ((uint32_t)3 << 28)

/* The numbers of one place, a pair a block. */
typedef struct place
{
    uint64_t seed;
    uint32_t view;
    uint32_t pixel;
    uint32_t sample;
} place;

static void take_pair(const place *of, uint32_t block, double pair[2])
{
    uint32_t words[4];
    cm_random_block(of->seed, of->view, of->pixel, of->sample, POISSON_BLOCKS + block, words);
    pair[0] = cm_fraction_of(words[0], words[1]);
    pair[1] = cm_fraction_of(words[2], words[3]);
}

/* The first count up to which the probabilities make up u. */
static double by_inversion(double u, double mean)
{
    double probability = cm_exact_exp(-mean);
    double sum = probability;
    double count = 0.0;
    while (u > sum && probability > 0x1p-60)
    {
        count += 1.0;
        probability *= mean / count;
        sum += probability;
    }
    return count;
}

/* ---- The logarithm of a probability ---- */

enum
{
    TABLE_COUNT = 16
};

/* log k! */
static const double log_factorial[TABLE_COUNT] = {0.0,
                                                  0.0,
                                                  0.69314718055994530942,
                                                  1.7917594692280550008,
                                                  3.1780538303479456197,
                                                  4.7874917427820459943,
                                                  6.5792512120101009951,
                                                  8.5251613610654143002,
                                                  10.604602902745250228,
                                                  12.801827480081469611,
                                                  15.104412573075515295,
                                                  17.502307845873885839,
                                                  19.987214495661886150,
                                                  22.552163853123422886,
                                                  25.191221182738681500,
                                                  27.899271383840891566};

/* k log(k / m) + m - k, which for k beside m is the small difference of large numbers: with v = (k - m) / (k + m) the
 * logarithm is 2 artanh v (Loader 2000, "Fast and accurate computation of binomial probabilities"). */
static double deviance(double k, double m)
{
    const double difference = k - m;
    if (fabs(difference) >= 0.1 * (k + m))
    {
        return k * cm_exact_log(k / m) - difference;
    }
    const double v = difference / (k + m);
    const double square = v * v;
    double sum = 0.0;
    for (int i = 19; i >= 3; i -= 2) /* 0.01^9 / 21 is below the last digit */
    {
        sum = (sum + 1.0 / (double)i) * square;
    }
    return difference * v + 2.0 * k * v * sum;
}

/* Of k >= 0, mean >= 10. From 16 on by Stirling's series (Loader 2000), which never has numbers that are much greater than
 * the result. */
static double log_probability(double k, double mean)
{
    if (k < (double)TABLE_COUNT)
    {
        return k * cm_exact_log(mean) - mean - log_factorial[(int)k];
    }
    const double square = k * k;
    const double series =
        (1.0 / 12.0 -
         (1.0 / 360.0 -
          (1.0 / 1260.0 - (1.0 / 1680.0 - (1.0 / 1188.0) / square) / square) / square) /
             square) /
        k;
    const double half_log_turn = 0.91893853320467274178; /* log(2 pi) / 2 */
    return -series - deviance(k, mean) - 0.5 * cm_exact_log(k) - half_log_turn;
}

/* ---- Rejection ---- */

/* Hoermann 1993, "The transformed rejection method for generating Poisson random variables", algorithm PTRS. The
 * probability of another turn is below 1/4, so that the blocks do not end. */
static double by_rejection(const place *of, double mean)
{
    const double b = 0.931 + 2.53 * sqrt(mean);
    const double a = -0.059 + 0.02483 * b;
    const double inverse_alpha = 1.1239 + 1.1328 / (b - 3.4);
    const double inside = 0.9277 - 3.6224 / (b - 2.0);
    for (uint32_t block = 0; block < 1000; block++)
    {
        double pair[2];
        take_pair(of, block, pair);
        const double u = pair[0] - 0.5;
        const double v = pair[1];
        const double edge = 0.5 - fabs(u);
        const double k = floor((2.0 * a / edge + b) * u + mean + 0.43);
        if (edge >= 0.07 && v <= inside)
        {
            return k;
        }
        if (k < 0.0 || (edge < 0.013 && v > edge))
        {
            continue;
        }
        if (cm_exact_log(v * inverse_alpha / (a / (edge * edge) + b)) <= log_probability(k, mean))
        {
            return k;
        }
    }
    return floor(mean); /* never met */
}

double cm_random_poisson(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample, double mean)
{
    const place of = {seed, view, pixel, sample};
    if (!(mean >= 0.0 && mean < (double)INFINITY))
    {
        return (double)NAN;
    }
    if (mean < 10.0)
    {
        double pair[2];
        take_pair(&of, 0, pair);
        return by_inversion(pair[0], mean);
    }
    return by_rejection(&of, mean);
}

void cm_random_poisson_array(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample,
                             size_t n, const double *mean, double *count)
{
    for (size_t i = 0; i < n; i++)
    {
        count[i] = cm_random_poisson(seed, view, first + (uint32_t)i, sample, mean[i]);
    }
}
