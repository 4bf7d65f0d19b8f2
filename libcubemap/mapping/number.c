/* SPDX-License-Identifier: MIT
 *
 * Reading decimal numbers. Numbers of everyday size are a 64-bit integer times or over a power of five, which 128 bits
 * hold exactly; the others are long integers. Both round once, at the end.
 */
#include <cubemap/number.h>

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "number_powers.h"

/* ------------------------------------------------------------------------------- what the text says */

/* DIGITS times a power of ten, and where the digits are if there are more than fit. */
typedef struct decimal
{
    uint64_t digits;   /* the first 19 significant digits */
    int digit_count;   /* of them */
    int64_t exponent;  /* the number is digits * 10^exponent, if exact */
    bool exact;        /* are these all digits that count? */
    const char *first; /* of the significant digits, NULL if there are none */
} decimal;

enum
{
    DIGITS_KEPT = 19
};

static bool is_digit(char character)
{
    return character >= '0' && character <= '9';
}

/* Take the digits at text into number; scale is 0 before the point, -1 behind it. */
static const char *take_digits(const char *text, const char *end, int scale, decimal *number)
{
    for (; text < end && is_digit(*text); text++)
    {
        const unsigned digit = (unsigned)(*text - '0');
        if (number->digit_count < DIGITS_KEPT)
        {
            number->digits = number->digits * 10 + digit;
            number->digit_count += number->digits != 0;
            number->first = number->digit_count == 1 ? text : number->first;
            number->exponent += scale;
        }
        else
        {
            number->exact = number->exact && digit == 0;
            number->exponent += scale + 1;
        }
    }
    return text;
}

/* Take an exponent, if there is a whole one at text. */
static const char *take_exponent(const char *text, const char *end, decimal *number)
{
    const char *at = text;
    if (at == end || (*at != 'e' && *at != 'E'))
    {
        return text;
    }
    at++;
    const bool negative = at < end && *at == '-';
    at += at < end && (*at == '-' || *at == '+');
    if (at == end || !is_digit(*at))
    {
        return text;
    }
    int64_t exponent = 0;
    for (; at < end && is_digit(*at); at++)
    {
        /* more than there can be digits to make up for it */
        exponent = exponent < INT64_C(1) << 56 ? exponent * 10 + (*at - '0') : exponent;
    }
    number->exponent += negative ? -exponent : exponent;
    return at;
}

/* ------------------------------------------------------------------------------- short numbers */

/* Many numbers have few digits: both operands are exact, and one operation rounds (Clinger 1990). */
static bool is_simple(const decimal *number)
{
    return FLT_EVAL_METHOD == 0 && number->exact && number->digits <= UINT64_C(1) << 53 &&
           number->exponent >= -22 && number->exponent <= 22;
}

static double simple_value(const decimal *number)
{
    static const double power_of_ten[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                            1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                            1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const double digits = (double)number->digits;
    return number->exponent < 0 ? digits / power_of_ten[-number->exponent]
                                : digits * power_of_ten[number->exponent];
}

#ifdef __SIZEOF_INT128__
static int leading_zeros(uint64_t value)
{
    return __builtin_clzll(value);
}

/* 2^exponent for a normal number. */
static double power_of_two(int exponent)
{
    const uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static bool is_middling(const decimal *number)
{
    return number->exact && number->exponent > -CM_POWERS_OF_FIVE &&
           number->exponent < CM_POWERS_OF_FIVE;
}

/* digits * 10^exponent; digits is not zero. */
static double middling_value(uint64_t digits, int exponent)
{
    if (exponent >= 0)
    {
        return (double)((cm_wide)digits * cm_power_of_five[exponent]) * power_of_two(exponent);
    }
    const int shift = leading_zeros(digits);
    const int divisor_shift = leading_zeros(cm_power_of_five[-exponent]);
    const uint64_t dividend = digits << shift;
    const uint64_t divisor = cm_power_of_five[-exponent] << divisor_shift;
    /* the quotient fills 64 bits; its last bit also stands for what is left, which is enough
       because only the first 53 bits stay */
    const int up = dividend >= divisor ? 63 : 64;
    const cm_wide shifted = (cm_wide)dividend << up;
    uint64_t quotient = (uint64_t)(shifted / divisor);
    quotient |= (uint64_t)((uint64_t)shifted != quotient * divisor);
    return (double)quotient * power_of_two(divisor_shift - shift - up + exponent);
}
#endif

/* ------------------------------------------------------------------------------- long numbers */

enum
{
    /* No double, and no place halfway between two, has more significant digits than 768: what follows them only
       decides whether it is one of those. */
    LONG_DIGITS_MAX = 770,
    /* 10^771, 5^1100 and twice as much are below 2^2624 */
    LIMBS = 82
};

/* A whole number below 2^2624, from its lowest 32 bits on; limbs from count on are not set. */
typedef struct integer
{
    uint32_t limb[LIMBS];
    int count;
} integer;

static void multiply_add(integer *number, uint32_t factor, uint32_t summand)
{
    uint64_t carry = summand;
    for (int i = 0; i < number->count; i++)
    {
        carry += (uint64_t)number->limb[i] * factor;
        number->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry != 0)
    {
        number->limb[number->count++] = (uint32_t)carry;
    }
}

static void multiply_by_power(integer *number, uint32_t base, int64_t exponent)
{
    while (exponent > 0)
    {
        uint32_t factor = 1;
        for (; exponent > 0 && factor <= UINT32_MAX / base; exponent--)
        {
            factor *= base;
        }
        multiply_add(number, factor, 0);
    }
}

/* Of a number that is not zero. */
static int bit_length(const integer *number)
{
    int bits = 32 * (number->count - 1);
    for (uint32_t top = number->limb[number->count - 1]; top != 0; top >>= 1)
    {
        bits++;
    }
    return bits;
}

static void shift_left(integer *number, int bits)
{
    const int limbs = bits / 32;
    memmove(number->limb + limbs, number->limb, (size_t)number->count * sizeof *number->limb);
    memset(number->limb, 0, (size_t)limbs * sizeof *number->limb);
    number->count += limbs;
    multiply_add(number, UINT32_C(1) << bits % 32, 0);
}

static int compare(const integer *a, const integer *b)
{
    if (a->count != b->count)
    {
        return a->count < b->count ? -1 : 1;
    }
    for (int i = a->count; i-- > 0;)
    {
        if (a->limb[i] != b->limb[i])
        {
            return a->limb[i] < b->limb[i] ? -1 : 1;
        }
    }
    return 0;
}

/* b is not more than a. */
static void subtract(integer *a, const integer *b)
{
    int64_t borrow = 0;
    for (int i = 0; i < a->count; i++)
    {
        borrow += (int64_t)a->limb[i] - (i < b->count ? (int64_t)b->limb[i] : 0);
        a->limb[i] = (uint32_t)borrow;
        borrow = borrow < 0 ? -1 : 0;
    }
    while (a->count > 0 && a->limb[a->count - 1] == 0)
    {
        a->count--;
    }
}

/* 64 bits, the first of which is set, times 2^exponent, and whether something is left behind them. */
typedef struct scaled
{
    uint64_t bits;
    int64_t exponent;
    bool rest;
} scaled;

/* Neither is zero; both are changed. */
static scaled divide(integer *dividend, integer *divisor)
{
    const int longer = bit_length(dividend) - bit_length(divisor);
    scaled quotient = {0, longer - 63, false};
    shift_left(longer < 0 ? dividend : divisor, longer < 0 ? -longer : longer);
    if (compare(dividend, divisor) < 0)
    {
        quotient.exponent--;
        shift_left(dividend, 1);
    }
    for (int i = 0; i < 64; i++)
    {
        quotient.bits <<= 1;
        if (compare(dividend, divisor) >= 0)
        {
            quotient.bits |= 1;
            subtract(dividend, divisor);
        }
        if (dividend->count > 0)
        {
            shift_left(dividend, 1);
        }
    }
    quotient.rest = dividend->count > 0;
    return quotient;
}

/* The nearest double, ties to even. */
static double round_scaled(scaled value)
{
    const int64_t power = value.exponent + 63; /* of two, of the first bit */
    const int64_t dropped = power < -1022 ? 11 - 1022 - power : 11;
    double result = (double)INFINITY;
    if (power <= 1023 && dropped <= 64)
    {
        uint64_t kept = dropped < 64 ? value.bits >> dropped : 0;
        const uint64_t half = UINT64_C(1) << (dropped - 1);
        const uint64_t below = value.bits & (half - 1);
        if ((value.bits & half) != 0 && (below != 0 || value.rest || (kept & 1) != 0))
        {
            kept++;
        }
        /* a carry goes into the exponent, as it is to */
        const uint64_t bits = kept + (power < -1022 ? 0 : (uint64_t)(power + 1022) << 52);
        memcpy(&result, &bits, sizeof result);
    }
    return power > 1023 ? (double)INFINITY : dropped > 64 ? 0.0 : result;
}

/* The digits up to the end of the number, as many as decide; returns the power of ten that they are times. */
static int64_t collect_digits(const decimal *number, const char *end, integer *digits)
{
    int64_t power = number->exponent + number->digit_count; /* of 0.DIGITS */
    int count = 0;
    bool rest = false;
    digits->count = 0;
    for (const char *at = number->first; at < end && (is_digit(*at) || *at == '.'); at++)
    {
        if (*at != '.' && count < LONG_DIGITS_MAX)
        {
            multiply_add(digits, 10, (uint32_t)(*at - '0'));
            count++;
        }
        else if (*at != '.')
        {
            rest = rest || *at != '0';
        }
    }
    if (rest)
    {
        multiply_add(digits, 10, 1);
        count++;
    }
    return power - count;
}

static double long_value(const decimal *number, const char *end)
{
    const int64_t power = number->exponent + number->digit_count;
    integer dividend;
    integer divisor = {{1}, 1};
    if (power > 310)
    {
        return (double)INFINITY;
    }
    if (power < -330)
    {
        return 0.0;
    }
    const int64_t exponent = collect_digits(number, end, &dividend);
    multiply_by_power(exponent < 0 ? &divisor : &dividend, 5, exponent < 0 ? -exponent : exponent);
    scaled value = divide(&dividend, &divisor);
    value.exponent += exponent;
    return round_scaled(value);
}

/* ------------------------------------------------------------------------------- reading */

/* Without the sign. */
static double decimal_value(const decimal *number, const char *end)
{
    if (number->digits == 0)
    {
        return 0.0;
    }
    if (is_simple(number))
    {
        return simple_value(number);
    }
#ifdef __SIZEOF_INT128__
    if (is_middling(number))
    {
        return middling_value(number->digits, (int)number->exponent);
    }
#endif
    return long_value(number, end);
}

size_t cm_number_read(const char *text, size_t length, double *value)
{
    if (length == 0) /* then text may be NULL */
    {
        return 0;
    }
    decimal number = {0, 0, 0, true, NULL};
    const char *const end = text + length;
    const char *at = text;
    const bool negative = *at == '-';
    at += *at == '-' || *at == '+';
    const char *const whole = at;
    at = take_digits(at, end, 0, &number);
    ptrdiff_t count = at - whole;
    if (at < end && *at == '.')
    {
        const char *const behind = at + 1;
        at = take_digits(behind, end, -1, &number);
        count += at - behind;
    }
    if (count == 0)
    {
        return 0;
    }
    at = take_exponent(at, end, &number);
    const double magnitude = decimal_value(&number, at);
    *value = negative ? -magnitude : magnitude;
    return (size_t)(at - text);
}

int cm_number_parse(const char *text, size_t length, double *value)
{
    double read = 0.0;
    const size_t count = cm_number_read(text, length, &read);
    if (count == 0 || count != length)
    {
        return 0;
    }
    *value = read;
    return 1;
}
