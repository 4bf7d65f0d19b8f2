/* SPDX-License-Identifier: MIT
 *
 * The counted generator, uniform and normal numbers.
 */
#include <cubemap/random.h>

#include <math.h>

#include "exact_logarithm.h"

/* ---- Philox 4x32-10 ---- */

enum
{
    ROUNDS = 10
};

/* What each kind of number counts its blocks from. */
#define UNIFORM_BLOCKS ((uint32_t)1 << 28)
#define NORMAL_BLOCKS ((uint32_t)2 << 28)

void cm_random_block(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample, uint32_t block,
                     uint32_t words[4])
{
    uint32_t key[2] = {(uint32_t)seed, (uint32_t)(seed >> 32)};
    uint32_t at[4] = {pixel, sample, view, block};
    for (int i = 0; i < ROUNDS; i++)
    {
        const uint64_t first = (uint64_t)0xD2511F53 * at[0];
        const uint64_t second = (uint64_t)0xCD9E8D57 * at[2];
        at[0] = (uint32_t)(second >> 32) ^ at[1] ^ key[0];
        at[1] = (uint32_t)second;
        at[2] = (uint32_t)(first >> 32) ^ at[3] ^ key[1];
        at[3] = (uint32_t)first;
        key[0] += 0x9E3779B9; /* the golden ratio, and the root of 3 less 1 */
        key[1] += 0xBB67AE85;
    }
    for (int i = 0; i < 4; i++)
    {
        words[i] = at[i];
    }
}

/* ---- Uniform numbers ---- */

static double uniform_of(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample,
                         uint32_t block)
{
    uint32_t words[4];
    cm_random_block(seed, view, pixel, sample, block, words);
    return cm_fraction_of(words[0], words[1]);
}

double cm_random_uniform(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample)
{
    return uniform_of(seed, view, pixel, sample, UNIFORM_BLOCKS);
}

void cm_random_uniform_array(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample,
                             size_t n, double *value)
{
    for (size_t i = 0; i < n; i++)
    {
        value[i] = cm_random_uniform(seed, view, first + (uint32_t)i, sample);
    }
}

/* ---- Normal numbers ---- */

/* Wichura 1988, "The percentage points of the normal distribution", algorithm AS 241, PPND16: quotients of polynomials for
 * the middle, the flanks and the tails; the coefficients as printed, the highest power first. */
static double quotient_of(const double above[8], const double below[8], double r)
{
    double numerator = above[0];
    double denominator = below[0];
    for (int i = 1; i < 8; i++)
    {
        numerator = numerator * r + above[i];
        denominator = denominator * r + below[i];
    }
    return numerator / denominator;
}

static const double middle_above[8] = {2.5090809287301226727e3, 3.3430575583588128105e4,
                                       6.7265770927008700853e4, 4.5921953931549871457e4,
                                       1.3731693765509461125e4, 1.9715909503065514427e3,
                                       1.3314166789178437745e2, 3.3871328727963666080e0};
static const double middle_below[8] = {5.2264952788528545610e3, 2.8729085735721942674e4,
                                       3.9307895800092710610e4, 2.1213794301586595867e4,
                                       5.3941960214247511077e3, 6.8718700749205790830e2,
                                       4.2313330701600911252e1, 1.0};
static const double flank_above[8] = {7.74545014278341407640e-4, 2.27238449892691845833e-2,
                                      2.41780725177450611770e-1, 1.27045825245236838258e0,
                                      3.64784832476320460504e0,  5.76949722146069140550e0,
                                      4.63033784615654529590e0,  1.42343711074968357734e0};
static const double flank_below[8] = {1.05075007164441684324e-9, 5.47593808499534494600e-4,
                                      1.51986665636164571966e-2, 1.48103976427480074590e-1,
                                      6.89767334985100004550e-1, 1.67638483018380384940e0,
                                      2.05319162663775882187e0,  1.0};
static const double tail_above[8] = {2.01033439929228813265e-7, 2.71155556874348757815e-5,
                                     1.24266094738807843860e-3, 2.65321895265761230930e-2,
                                     2.96560571828504891230e-1, 1.78482653991729133580e0,
                                     5.46378491116411436990e0,  6.65790464350110377720e0};
static const double tail_below[8] = {2.04426310338993978564e-15, 1.42151175831644588870e-7,
                                     1.84631831751005468180e-5,  7.86869131145613259100e-4,
                                     1.48753612908506148525e-2,  1.36929880922735805310e-1,
                                     5.99832206555887937690e-1,  1.0};

static double normal_at(double p)
{
    const double q = p - 0.5;
    if (fabs(q) <= 0.425)
    {
        return q * quotient_of(middle_above, middle_below, 0.180625 - q * q);
    }
    const double r = sqrt(-cm_exact_log(q < 0.0 ? p : 1.0 - p));
    const double x = r <= 5.0 ? quotient_of(flank_above, flank_below, r - 1.6)
                              : quotient_of(tail_above, tail_below, r - 5.0);
    return q < 0.0 ? -x : x;
}

double cm_random_normal(uint64_t seed, uint32_t view, uint32_t pixel, uint32_t sample)
{
    return normal_at(uniform_of(seed, view, pixel, sample, NORMAL_BLOCKS));
}

void cm_random_normal_array(uint64_t seed, uint32_t view, uint32_t first, uint32_t sample, size_t n,
                            double *value)
{
    for (size_t i = 0; i < n; i++)
    {
        value[i] = cm_random_normal(seed, view, first + (uint32_t)i, sample);
    }
}
