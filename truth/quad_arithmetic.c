/* SPDX-License-Identifier: MIT
 *
 * Sums, differences, products and quotients of binary128, in less time than the compiler's own and with the same bits:
 * correctly rounded to nearest, ties to even. The linker puts them in place of __addtf3 and its kin (--wrap). What is not plain,
 * as subnormals, infinities and NaN are not, they leave to those, under the names that --wrap gives them.
 *
 * They raise no exception flags but those, and look at no rounding mode: what judges asks for neither.
 */
#include <stdint.h>
#include <string.h>

/* 128 bits of either kind are no words of ISO C */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"

typedef __float128 quad;
typedef unsigned __int128 wide;
typedef uint64_t words __attribute__((vector_size(16)));

quad __real___addtf3(quad a, quad b);
quad __real___subtf3(quad a, quad b);
quad __real___multf3(quad a, quad b);
quad __real___divtf3(quad a, quad b);
quad __wrap___addtf3(quad a, quad b);
quad __wrap___subtf3(quad a, quad b);
quad __wrap___multf3(quad a, quad b);
quad __wrap___divtf3(quad a, quad b);

enum
{
    FRACTION = 112,   /* bits of a number's fraction, above which are its exponent and its sign */
    BIAS = 0x3fff,    /* the exponent of 1 */
    LARGEST = 0x7ffe, /* the exponent of the largest finite numbers */
    SPARE = 15        /* bits below a fraction whose one before it is uppermost of 128 */
};

#define SIGN ((wide)1 << 127)

/* From words to a vector and back in registers: a number whose halves are stored and which is loaded at once is waited for. */
static inline wide bits_of(quad a)
{
    words w;
    memcpy(&w, &a, sizeof w);
    return (wide)w[1] << 64 | w[0];
}

static inline quad of_bits(wide bits)
{
    const words w = {(uint64_t)bits, (uint64_t)(bits >> 64)};
    quad a;
    memcpy(&a, &w, sizeof a);
    return a;
}

static inline int exponent_of(wide a)
{
    return (int)((uint64_t)(a >> 64) >> 48) & 0x7fff;
}

/* The fraction with the one before it, uppermost, of a normal number. */
static inline wide whole_of(wide a)
{
    return a << SPARE | SIGN;
}

static inline int is_normal(int exponent)
{
    return (unsigned)exponent - 1u < (unsigned)LARGEST;
}

/* Whether a number of that exponent stays normal and finite if rounding makes it a power of two. */
static inline int is_safe(int exponent)
{
    return (unsigned)exponent - 1u < (unsigned)LARGEST - 1u;
}

/* Rounded and put together; the last of the spare bits is 1 if anything below it is not 0. No branch asks what is as often so as
 * otherwise. The one before the fraction is a step of the exponent. */
static inline quad put(wide sign, int exponent, wide whole)
{
    const wide kept = whole >> SPARE;
    const unsigned rest = (unsigned)whole & ((1u << SPARE) - 1u);
    const wide up = rest + ((unsigned)kept & 1u) > 1u << (SPARE - 1);
    return of_bits(sign | (((wide)(unsigned)(exponent - 1) << FRACTION) + kept + up));
}

/* Twice as large if its uppermost bit is 0. */
static inline wide lifted(wide a, int *exponent)
{
    const wide is_upper = a >> 127;
    *exponent += (int)is_upper - 1;
    return a + (a & (is_upper - 1));
}

/* The upper half of a product; its last bit is 1 if the lower half is not 0. */
static inline wide times(wide a, wide b)
{
    const uint64_t a1 = (uint64_t)(a >> 64);
    const uint64_t a0 = (uint64_t)a;
    const uint64_t b1 = (uint64_t)(b >> 64);
    const uint64_t b0 = (uint64_t)b;
    const wide low = (wide)a0 * b0;
    /* no sum here is more than 128 bits hold */
    const wide middle = (wide)a1 * b0 + (low >> 64);
    const wide other = (wide)a0 * b1 + (uint64_t)middle;
    const wide high = (wide)a1 * b1 + (middle >> 64) + (other >> 64);
    return high | (((uint64_t)other | (uint64_t)low) != 0);
}

quad __wrap___multf3(quad a, quad b)
{
    const wide x = bits_of(a);
    const wide y = bits_of(b);
    if (!is_normal(exponent_of(x)) || !is_normal(exponent_of(y)))
    {
        return __real___multf3(a, b);
    }
    int exponent = exponent_of(x) + exponent_of(y) - BIAS + 1;
    const wide whole = lifted(times(whole_of(x), whole_of(y)), &exponent);
    return is_safe(exponent) ? put((x ^ y) & SIGN, exponent, whole) : __real___multf3(a, b);
}

/* Shifted down by so many bits; the last bit is 1 if any of them was. */
static inline wide shifted(wide a, int by)
{
    const wide down = by > 127 ? 0 : a >> by;
    return down | (by > 127 || down << by != a);
}

static inline int zeros_before(wide a)
{
    const uint64_t high = (uint64_t)(a >> 64);
    return high != 0 ? __builtin_clzll(high) : 64 + __builtin_clzll((uint64_t)a);
}

/* The sum of normal numbers; 0 where it cannot be said. */
static inline int add(wide x, wide y, quad *sum)
{
    /* the larger first */
    const wide change = (x ^ y) & -(wide)((x & ~SIGN) < (y & ~SIGN));
    x ^= change;
    y ^= change;
    const wide is_less = -(wide)((x ^ y) >> 127);
    /* one bit for what is carried */
    const wide smaller = shifted(whole_of(y) >> 1, exponent_of(x) - exponent_of(y));
    const wide whole = (whole_of(x) >> 1) + (smaller ^ is_less) - is_less;
    if (whole == 0)
    {
        *sum = of_bits(0);
        return 1;
    }
    const int up = zeros_before(whole);
    const int exponent = exponent_of(x) + 1 - up;
    *sum = put(x & SIGN, exponent, whole << up);
    return is_safe(exponent);
}

/* The same of any numbers. */
static inline int add_any(wide x, wide y, quad *sum)
{
    const int is_first = is_normal(exponent_of(x));
    const int is_second = is_normal(exponent_of(y));
    if (is_first && is_second)
    {
        return add(x, y, sum);
    }
    /* 0 more changes nothing */
    *sum = of_bits(is_first ? x : y);
    return (is_first && y << 1 == 0) || (is_second && x << 1 == 0);
}

quad __wrap___addtf3(quad a, quad b)
{
    quad sum;
    return add_any(bits_of(a), bits_of(b), &sum) ? sum : __real___addtf3(a, b);
}

quad __wrap___subtf3(quad a, quad b)
{
    quad sum;
    return add_any(bits_of(a), bits_of(b) ^ SIGN, &sum) ? sum : __real___subtf3(a, b);
}

/* One digit, of 64 bits, of remainder / divisor, for a divisor of 128 bits and a remainder below it; the remainder becomes that
 * of the next digit. */
static inline uint64_t next_digit(wide *remainder, wide divisor)
{
    const uint64_t d1 = (uint64_t)(divisor >> 64);
    const uint64_t d0 = (uint64_t)divisor;
    const uint64_t r1 = (uint64_t)(*remainder >> 64);
    /* by the upper halves, which is 2 too much at most */
    wide digit = r1 >= d1 ? UINT64_MAX : *remainder / d1;
    wide left = *remainder - digit * d1; /* with 64 bits more below, which are 0 */
    wide taken = digit * d0;
    while (left >> 64 == 0 && taken > left << 64)
    {
        digit--;
        left += d1;
        taken -= d0;
    }
    *remainder = (left << 64) - taken;
    return (uint64_t)digit;
}

quad __wrap___divtf3(quad a, quad b)
{
    const wide x = bits_of(a);
    const wide y = bits_of(b);
    if (!is_normal(exponent_of(x)) || !is_normal(exponent_of(y)))
    {
        return __real___divtf3(a, b);
    }
    /* half of x / y, in (1/4, 1) without the exponents, has 128 bits after the point */
    wide remainder = whole_of(x) >> 1;
    wide quotient = (wide)next_digit(&remainder, whole_of(y)) << 64;
    quotient |= next_digit(&remainder, whole_of(y));
    int exponent = exponent_of(x) - exponent_of(y) + BIAS;
    const wide whole = lifted(quotient | (remainder != 0), &exponent);
    return is_safe(exponent) ? put((x ^ y) & SIGN, exponent, whole) : __real___divtf3(a, b);
}

#pragma GCC diagnostic pop
