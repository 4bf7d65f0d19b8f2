/* SPDX-License-Identifier: MIT
 *
 * Logarithm and exponential of nothing but operations that IEEE 754 rounds correctly, so that every compiler and every C
 * library has the same bits; and fractions of random words. For random.c and poisson.c.
 */
#ifndef MODULES_SCENE_EXACT_LOGARITHM_H
#define MODULES_SCENE_EXACT_LOGARITHM_H

#include <math.h>
#include <stdint.h>

/* log 2 as a double whose product with any exponent is exact, and the rest */
#define CM_LOG2_HIGH 0x1.62e42fefa38p-1
#define CM_LOG2_LOW 0x1.ef35793c7673p-45

/* In (0, 1): 52 bits, and half of the last one. */
static inline double cm_fraction_of(uint32_t high, uint32_t low)
{
    const uint64_t bits = ((uint64_t)high << 20) | (low >> 12);
    return ((double)bits + 0.5) * 0x1p-52;
}

/* Of x > 0, normal and finite: x = 2^e m, m in [sqrt(1/2), sqrt 2), log m = 2 artanh s, s = (m - 1) / (m + 1), by the
 * series, of which s^2 <= 0.0295 needs eleven terms. */
static inline double cm_exact_log(double x)
{
    int exponent;
    double m = frexp(x, &exponent);
    if (m < 0.70710678118654752440)
    {
        m *= 2.0;
        exponent--;
    }
    const double f = m - 1.0;
    const double s = f / (m + 1.0);
    const double square = s * s;
    double sum = 0.0;
    for (int k = 23; k >= 3; k -= 2)
    {
        sum = (sum + 1.0 / (double)k) * square;
    }
    /* 2 s = f - s f, so that f, which is exact, carries the most */
    const double rest = 2.0 * s * sum - s * f;
    return (double)exponent * CM_LOG2_HIGH + (f + (rest + (double)exponent * CM_LOG2_LOW));
}

/* Of x in [-700, 700]: 2^k e^r, |r| <= log 2 / 2, by the series. */
static inline double cm_exact_exp(double x)
{
    const double k = floor(x * 1.4426950408889634074 + 0.5);
    const double r = (x - k * CM_LOG2_HIGH) - k * CM_LOG2_LOW;
    double sum = 1.0;
    for (int i = 14; i >= 1; i--)
    {
        sum = 1.0 + sum * r / (double)i;
    }
    return ldexp(sum, (int)k);
}

#endif
