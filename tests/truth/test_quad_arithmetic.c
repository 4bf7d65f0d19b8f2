/* SPDX-License-Identifier: MIT
 *
 * The faster arithmetic of quadruple precision (truth/quad_arithmetic.c), which this program is linked with, against the compiler's
 * own, bit for bit, NaN and signs of zero as well: all pairs of hard numbers, and random pairs that are apart by all shifts.
 */
#include "tests/suite.h"

#include <stdint.h>
#include <string.h>

/* 128 bits of either kind are no words of ISO C */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"

typedef __float128 quad;
typedef unsigned __int128 wide;

quad __real___addtf3(quad a, quad b);
quad __real___subtf3(quad a, quad b);
quad __real___multf3(quad a, quad b);
quad __real___divtf3(quad a, quad b);

enum
{
    FRACTION = 112,
    BIAS = 0x3fff,
    INFINITE = 0x7fff
};

static wide bits_of(quad a)
{
    wide bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

static quad make(unsigned sign, unsigned exponent, wide fraction)
{
    const wide bits =
        (wide)sign << 127 | (wide)exponent << FRACTION | (fraction & (((wide)1 << FRACTION) - 1));
    quad a;
    memcpy(&a, &bits, sizeof a);
    return a;
}

static size_t pairs;

static void check_pair(quad a, quad b)
{
    /* what operators are made of is in the place of the compiler's own */
    const quad found[4] = {a + b, a - b, a * b, a / b};
    const quad wanted[4] = {__real___addtf3(a, b), __real___subtf3(a, b), __real___multf3(a, b),
                            __real___divtf3(a, b)};
    for (int i = 0; i < 4; i++)
    {
        const wide f = bits_of(found[i]);
        const wide w = bits_of(wanted[i]);
        REQUIRE(f == w, "%016llx%016llx %c %016llx%016llx: %016llx%016llx, not %016llx%016llx",
                (unsigned long long)(bits_of(a) >> 64), (unsigned long long)bits_of(a), "+-*/"[i],
                (unsigned long long)(bits_of(b) >> 64), (unsigned long long)bits_of(b),
                (unsigned long long)(f >> 64), (unsigned long long)f, (unsigned long long)(w >> 64),
                (unsigned long long)w);
    }
    pairs++;
}

/* Fractions that tie, carry and cancel: none, all, the halves of them, and one bit anywhere. */
static wide hard_fraction(size_t i)
{
    static const wide known[] = {0, ~(wide)0, 1, 2, 3, 4, 5, 6, 7, ~(wide)1, ~(wide)2};
    const size_t count = sizeof known / sizeof known[0];
    return i < count ? known[i] : (wide)1 << (i - count) * 8 % FRACTION;
}

/* Every sign and fraction with exponents of 0 and subnormals, of the ends, about 1, and of infinities and NaN. */
START_TEST(test_hard_pairs)
{
    static const unsigned exponents[] = {0,
                                         1,
                                         2,
                                         57,
                                         112,
                                         113,
                                         BIAS / 2,
                                         BIAS - 1,
                                         BIAS,
                                         BIAS + 1,
                                         BIAS + 57,
                                         BIAS + 112,
                                         BIAS + 113,
                                         BIAS + 114,
                                         BIAS + BIAS / 2,
                                         INFINITE - 113,
                                         INFINITE - 2,
                                         INFINITE - 1,
                                         INFINITE};
    enum
    {
        FRACTIONS = 25,
        EXPONENTS = sizeof exponents / sizeof exponents[0],
        ALL = 2 * FRACTIONS * EXPONENTS
    };
    static quad hard[ALL];
    for (size_t i = 0; i < ALL; i++)
    {
        hard[i] = make(i % 2, exponents[i / 2 % EXPONENTS], hard_fraction(i / 2 / EXPONENTS));
    }
    for (size_t i = 0; i < ALL; i++)
    {
        for (size_t k = 0; k < ALL; k += step_of(7))
        {
            check_pair(hard[i], hard[k]);
        }
    }
}
END_TEST

static wide any_bits(uint64_t *state)
{
    const wide high = next_bits(state);
    return high << 64 | next_bits(state);
}

/* Some with few bits, all of them at the top or all at the bottom, which tie and cancel. */
static wide any_fraction(uint64_t *state)
{
    const wide bits = any_bits(state);
    const unsigned by = (unsigned)(next_bits(state) % FRACTION);
    switch (next_bits(state) % 4)
    {
    case 0:
        return bits >> (128 - FRACTION) >> by << by;
    case 1:
        return bits >> (128 - FRACTION) >> by;
    case 2:
        return ~(bits >> (128 - FRACTION) >> by);
    default:
        return bits;
    }
}

/* Exponents as far apart as sums can see, and any; the second number is sometimes the first but for its last bits. */
START_TEST(test_random_pairs)
{
    uint64_t state = 1;
    for (size_t i = 0; i < 1000000; i += step_of(50))
    {
        const wide first = any_fraction(&state);
        const wide other =
            next_bits(&state) % 8 == 0 ? first + next_bits(&state) % 5 - 2 : any_fraction(&state);
        const unsigned exponent = (unsigned)next_bits(&state) % INFINITE;
        const unsigned apart = (unsigned)next_bits(&state) % 120;
        const unsigned next = i % 4 == 0         ? (unsigned)next_bits(&state) & INFINITE
                              : exponent > apart ? exponent - apart
                                                 : exponent + apart;
        const unsigned signs = (unsigned)next_bits(&state);
        const quad a = make(signs & 1u, exponent, first);
        const quad b = make(signs >> 1 & 1u, i % 16 == 1 ? exponent : next, other);
        check_pair(a, b);
        check_pair(b, a);
    }
    REQUIRE(pairs > 0, "no pairs");
}
END_TEST

#pragma GCC diagnostic pop

int main(void)
{
    const TTest *const tests[] = {test_hard_pairs, test_random_pairs, NULL};
    return run_suite("quad arithmetic", tests);
}
