/* SPDX-License-Identifier: MIT
 *
 * Writing decimal numbers. For those of everyday size the digits come from one multiplication by a power of five in 128
 * bits, exactly; for the others from all the decimal digits that the double has. Both round once.
 */
#include <cubemap/number.h>

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "number_powers.h"

/* The significant digits of a positive number as a whole number in [10^(digits - 1), 10^digits), and the power of ten
 * of the first of them. */
typedef struct significant
{
    uint64_t digits;
    int power;
} significant;

/* 10^0 .. 10^17, which all are exact. */
static const uint64_t power_of_ten[CM_NUMBER_DIGITS + 1] = {
    1ULL,
    10ULL,
    100ULL,
    1000ULL,
    10000ULL,
    100000ULL,
    1000000ULL,
    10000000ULL,
    100000000ULL,
    1000000000ULL,
    10000000000ULL,
    100000000000ULL,
    1000000000000ULL,
    10000000000000ULL,
    100000000000000ULL,
    1000000000000000ULL,
    10000000000000000ULL,
    100000000000000000ULL,
};

/* significand * 2^exponent is the positive value. */
static uint64_t split(double value, int *exponent)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const int field = (int)(bits >> 52);
    const uint64_t rest = bits & ((UINT64_C(1) << 52) - 1);
    *exponent = (field == 0 ? 1 : field) - 1075;
    return field == 0 ? rest : rest | UINT64_C(1) << 52;
}

/* ------------------------------------------------------------------------------- everyday size */

#ifdef __SIZEOF_INT128__
/* The whole number nearest to significand * 2^exponent * 10^scale, ties to even; scale is in
 * [0, 32]. The result must be below 2^63. */
static uint64_t round_scaled(uint64_t significand, int exponent, int scale)
{
    const int first = scale < CM_POWERS_OF_FIVE ? scale : CM_POWERS_OF_FIVE - 1;
    /* below 2^53 * 5^32 < 2^128 */
    const cm_wide product =
        (cm_wide)significand * cm_power_of_five[first] * cm_power_of_five[scale - first];
    const int right = -(exponent + scale);
    if (right <= 0)
    {
        return (uint64_t)product << -right;
    }
    const cm_wide half = (cm_wide)1 << (right - 1);
    const cm_wide rest = product & (((cm_wide)1 << right) - 1);
    const uint64_t floored = (uint64_t)(product >> right);
    return floored + (uint64_t)(rest > half || (rest == half && (floored & 1) != 0));
}

/* False if the value is too large or too small for 128 bits. */
static bool find_digits(double value, int digits, significant *found)
{
    int exponent;
    const uint64_t significand = split(value, &exponent);
    /* floor(log10(2^(exponent + 52))): right, or one too small */
    int power = (int)(((int64_t)(exponent + 52) * 1292913986) >> 32);
    for (int attempt = 0; attempt < 2; attempt++, power++)
    {
        const int scale = digits - 1 - power;
        if (scale < 0 || scale > 32)
        {
            return false;
        }
        const uint64_t rounded = round_scaled(significand, exponent, scale);
        if (rounded < power_of_ten[digits])
        {
            found->digits = rounded;
            found->power = power;
            return true;
        }
        /* 9.99... that rounds up to 10 is found again as 1.00 with the next power */
    }
    return false;
}
#endif

/* ------------------------------------------------------------------------------- any size */

enum
{
    GROUPS = 90,     /* 2^53 * 5^1074 has 767 digits */
    GROUP_DIGITS = 9 /* of each */
};

/* A whole number in groups of nine decimal digits, from its lowest on. */
typedef struct groups
{
    uint32_t group[GROUPS];
    int count;
} groups;

static void multiply(groups *number, uint32_t factor)
{
    uint64_t carry = 0;
    for (int i = 0; i < number->count; i++)
    {
        carry += (uint64_t)number->group[i] * factor;
        number->group[i] = (uint32_t)(carry % 1000000000);
        carry /= 1000000000;
    }
    for (; carry != 0; carry /= 1000000000)
    {
        number->group[number->count++] = (uint32_t)(carry % 1000000000);
    }
}

static void multiply_by_power(groups *number, uint32_t base, int exponent)
{
    while (exponent > 0)
    {
        uint32_t factor = 1;
        for (; exponent > 0 && factor <= UINT32_MAX / base; exponent--)
        {
            factor *= base;
        }
        multiply(number, factor);
    }
}

/* All the digits of a positive value, the first of which is not zero; the value is their number times
 * 10^*exponent. */
static int expand(double value, char text[GROUPS * GROUP_DIGITS], int *exponent)
{
    groups number = {{1}, 1};
    int binary;
    uint64_t significand = split(value, &binary);
    number.group[0] = (uint32_t)(significand % 1000000000);
    number.group[1] = (uint32_t)(significand / 1000000000);
    number.count = number.group[1] != 0 ? 2 : 1;
    /* 2^-n is 5^n 10^-n */
    *exponent = binary < 0 ? binary : 0;
    multiply_by_power(&number, binary < 0 ? 5 : 2, binary < 0 ? -binary : binary);
    int length = 0;
    for (int i = number.count; i-- > 0;)
    {
        for (uint32_t unit = 100000000; unit > 0; unit /= 10)
        {
            text[length] = (char)('0' + number.group[i] / unit % 10);
            length += length > 0 || text[length] != '0';
        }
    }
    return length;
}

static significant find_digits_anywhere(double value, int digits)
{
    char text[GROUPS * GROUP_DIGITS];
    int exponent;
    const int length = expand(value, text, &exponent);
    significant found = {0, length - 1 + exponent};
    for (int i = 0; i < digits; i++)
    {
        found.digits = found.digits * 10 + (uint64_t)(i < length ? text[i] - '0' : 0);
    }
    bool more = false;
    for (int i = digits + 1; i < length; i++)
    {
        more = more || text[i] != '0';
    }
    const char next = digits < length ? text[digits] : '0';
    if (next > '5' || (next == '5' && (more || (found.digits & 1) != 0)))
    {
        found.digits++;
    }
    if (found.digits == power_of_ten[digits])
    {
        found.digits /= 10;
        found.power++;
    }
    return found;
}

/* ------------------------------------------------------------------------------- text */

/* Eight digits, with leading zeros. */
static void write_eight(uint32_t value, char *text)
{
    static const char pairs[] = "00010203040506070809101112131415161718192021222324"
                                "25262728293031323334353637383940414243444546474849"
                                "50515253545556575859606162636465666768697071727374"
                                "75767778798081828384858687888990919293949596979899";
    const uint32_t high = value / 10000;
    const uint32_t low = value % 10000;
    memcpy(text, pairs + 2 * (high / 100), 2);
    memcpy(text + 2, pairs + 2 * (high % 100), 2);
    memcpy(text + 4, pairs + 2 * (low / 100), 2);
    memcpy(text + 6, pairs + 2 * (low % 100), 2);
}

/* The digits from the first to the last that is not zero; returns how many there are. */
static int write_digits(uint64_t value, int digits, char text[CM_NUMBER_DIGITS])
{
    char padded[24];
    const uint64_t high = value / 100000000;
    write_eight((uint32_t)(high / 100000000), padded);
    write_eight((uint32_t)(high % 100000000), padded + 8);
    write_eight((uint32_t)(value % 100000000), padded + 16);
    const char *const first = padded + 24 - digits;
    int count = digits;
    while (count > 1 && first[count - 1] == '0')
    {
        count--;
    }
    memcpy(text, first, (size_t)count);
    return count;
}

/* e-05, e+100 */
static char *write_exponent(int power, char *text)
{
    const int magnitude = power < 0 ? -power : power;
    *text++ = 'e';
    *text++ = power < 0 ? '-' : '+';
    if (magnitude >= 100)
    {
        *text++ = (char)('0' + magnitude / 100);
    }
    *text++ = (char)('0' + magnitude / 10 % 10);
    *text++ = (char)('0' + magnitude % 10);
    return text;
}

/* Lay digits out as %g does for that precision; power is that of the first digit. */
static char *lay_out(const char *digits, int count, int power, int precision, char *text)
{
    if (power < -4 || power >= precision)
    {
        *text++ = *digits++;
        count--;
        if (count > 0)
        {
            *text++ = '.';
        }
        memcpy(text, digits, (size_t)count);
        return write_exponent(power, text + count);
    }
    if (power < 0)
    {
        memcpy(text, "0.0000", 6);
        text += 1 - power;
        memcpy(text, digits, (size_t)count);
        return text + count;
    }
    const int whole = power + 1;
    const int present = count < whole ? count : whole;
    memcpy(text, digits, (size_t)present);
    memset(text + present, '0', (size_t)(whole - present));
    text += whole;
    if (count > present)
    {
        *text++ = '.';
        memcpy(text, digits + present, (size_t)(count - present));
        text += count - present;
    }
    return text;
}

static size_t write_word(const char *word, char text[CM_NUMBER_SIZE])
{
    const size_t length = strlen(word);
    memcpy(text, word, length + 1);
    return length;
}

size_t cm_number_write(double value, int digits, char text[CM_NUMBER_SIZE])
{
    const double magnitude = fabs(value);
    const int precision = digits < 1 ? 1 : digits > CM_NUMBER_DIGITS ? CM_NUMBER_DIGITS : digits;
    significant found;
    if (isnan(value) || isinf(value))
    {
        return write_word(isnan(value) ? "nan" : value < 0.0 ? "-inf" : "inf", text);
    }
    if (value == 0.0)
    {
        return write_word("0", text);
    }
#ifdef __SIZEOF_INT128__
    /* the bounds only keep the estimate's arithmetic in its range; find_digits has the real ones */
    if (!(magnitude > 1e-40 && magnitude < 1e20 && find_digits(magnitude, precision, &found)))
#endif
    {
        found = find_digits_anywhere(magnitude, precision);
    }
    char digit[CM_NUMBER_DIGITS];
    const int count = write_digits(found.digits, precision, digit);
    char *at = text;
    *at = '-';
    at += value < 0.0;
    at = lay_out(digit, count, found.power, precision, at);
    *at = '\0';
    return (size_t)(at - text);
}

size_t cm_number_write_shortest(double value, char text[CM_NUMBER_SIZE])
{
    for (int digits = 15; digits < CM_NUMBER_DIGITS; digits++)
    {
        double again;
        const size_t length = cm_number_write(value, digits, text);
        if (cm_number_read(text, length, &again) != 0 && again == value)
        {
            return length;
        }
    }
    return cm_number_write(value, CM_NUMBER_DIGITS, text);
}
