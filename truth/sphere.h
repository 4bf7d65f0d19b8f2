/* SPDX-License-Identifier: MIT
 *
 * Random directions, and angles on the sphere: what tests and benchmarks share.
 */
#ifndef TRUTH_SPHERE_H
#define TRUTH_SPHERE_H

#include <math.h>
#include <stdint.h>

/* metres; error on Earth = angle times this */
#define EARTH_RADIUS 6371007.2

/* xorshift64*, so that a failure can be found again */
static inline uint64_t next_bits(uint64_t *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return *state * 0x2545f4914f6cdd1dull;
}

/* uniform in [-1, 1) */
static inline double next_real(uint64_t *state)
{
    return (double)(next_bits(state) >> 11) * 0x1p-52 - 1.0;
}

/* a point of the ball's shell between radius 1/4 and 1: a uniform direction of no special length */
static inline void next_direction(uint64_t *state, double direction[3])
{
    double square;
    do
    {
        square = 0.0;
        for (int i = 0; i < 3; i++)
        {
            direction[i] = next_real(state);
            square += direction[i] * direction[i];
        }
    } while (square > 1.0 || square < 0.0625);
}

/* the angle between two directions of any length, accurate when it is small */
static inline double angle_between(const double a[3], const double b[3])
{
    long double cross[3];
    long double dot = 0.0L;
    for (int i = 0; i < 3; i++)
    {
        int j = (i + 1) % 3;
        int k = (i + 2) % 3;
        cross[i] = (long double)a[j] * b[k] - (long double)a[k] * b[j];
        dot += (long double)a[i] * b[i];
    }
    return (double)atan2l(sqrtl(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]),
                          dot);
}

static inline double earth_metres(const double a[3], const double b[3])
{
    return angle_between(a, b) * EARTH_RADIUS;
}

#endif
