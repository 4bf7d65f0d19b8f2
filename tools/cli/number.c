/* SPDX-License-Identifier: MIT
 *
 * Both directions multiply or divide a 64-bit integer by a power of five in 128 bits, exactly, and
 * round once. That covers every number a point on a face or on the Earth is likely to have; what it
 * does not cover goes to strtod and snprintf.
 */
#include "number.h"

#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 wide;

/* 5^27 is the largest power of five below 2^64. */
#define POWERS_OF_FIVE 28

static const uint64_t power_of_five[POWERS_OF_FIVE] = {
    1ULL,
    5ULL,
    25ULL,
    125ULL,
    625ULL,
    3125ULL,
    15625ULL,
    78125ULL,
    390625ULL,
    1953125ULL,
    9765625ULL,
    48828125ULL,
    244140625ULL,
    1220703125ULL,
    6103515625ULL,
    30517578125ULL,
    152587890625ULL,
    762939453125ULL,
    3814697265625ULL,
    19073486328125ULL,
    95367431640625ULL,
    476837158203125ULL,
    2384185791015625ULL,
    11920928955078125ULL,
    59604644775390625ULL,
    298023223876953125ULL,
    1490116119384765625ULL,
    7450580596923828125ULL,
};

/* 10^0 .. 10^17, which all are exact. */
static const uint64_t power_of_ten[NUMBER_DIGITS_MAX + 1] = {
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
#endif

/* ------------------------------------------------------------------------------- reading */

/* What the text of a number says: 0.DIGITS or DIGITS times a power of ten. */
typedef struct decimal
{
    uint64_t digits; /* the first 19 significant digits */
    long exponent;   /* the number is digits * 10^exponent, if exact */
    int digit_count; /* significant digits in digits */
    bool exact;      /* are these all digits that count? */
    bool negative;
} decimal;

static bool is_digit(char character)
{
    return character >= '0' && character <= '9';
}

/* Take the digits at text into number; scale is 0 before the point, -1 behind it. */
static const char *take_digits(const char *text, const char *end, int scale, decimal *number)
{
    while (text < end && is_digit(*text))
    {
        const unsigned digit = (unsigned)(*text - '0');
        if (number->digit_count < 19)
        {
            number->digits = number->digits * 10 + digit;
            number->digit_count += number->digits != 0;
            number->exponent += scale;
        }
        else
        {
            number->exact = number->exact && digit == 0;
            number->exponent += scale + 1;
        }
        text++;
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
    long exponent = 0;
    for (; at < end && is_digit(*at); at++)
    {
        /* far beyond what a double can hold, however many digits stand before it */
        exponent = exponent < 100000 ? exponent * 10 + (*at - '0') : exponent;
    }
    number->exponent += negative ? -exponent : exponent;
    return at;
}

/* Is there this word, whatever its case? word is in lower case. */
static bool starts_with(const char *text, const char *end, const char *word)
{
    for (; *word != '\0'; word++, text++)
    {
        if (text == end || (*text != *word && *text != *word - 'a' + 'A'))
        {
            return false;
        }
    }
    return true;
}

/* text is behind the sign. */
static const char *read_word(const char *text, const char *end, bool negative, double *value)
{
    if (starts_with(text, end, "nan"))
    {
        *value = (double)NAN;
        return text + 3;
    }
    if (starts_with(text, end, "inf"))
    {
        *value = negative ? (double)-INFINITY : (double)INFINITY;
        return text + (starts_with(text, end, "infinity") ? 8 : 3);
    }
    return NULL;
}

/* text is known to be a number in our form, without a zero byte behind it. */
static double read_with_strtod(const char *text, const char *end)
{
    char copy[NUMBER_READ_MAX + 16];
    const char *const mark = localeconv()->decimal_point;
    const char *const point = memchr(text, '.', (size_t)(end - text));
    size_t length = (size_t)((point != NULL ? point : end) - text);

    memcpy(copy, text, length);
    if (point != NULL)
    {
        const size_t behind = (size_t)(end - point) - 1;
        const size_t mark_length = strlen(mark) < 16 ? strlen(mark) : 15;
        memcpy(copy + length, mark, mark_length);
        memcpy(copy + length + mark_length, point + 1, behind);
        length += mark_length + behind;
    }
    copy[length] = '\0';
    return strtod(copy, NULL);
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

/* digits * 10^exponent; digits is not zero, exponent is in (-POWERS_OF_FIVE, POWERS_OF_FIVE). */
static double scale_decimal(uint64_t digits, int exponent)
{
    if (exponent >= 0)
    {
        return (double)((wide)digits * power_of_five[exponent]) * power_of_two(exponent);
    }
    const int shift = leading_zeros(digits);
    const int divisor_shift = leading_zeros(power_of_five[-exponent]);
    const uint64_t dividend = digits << shift;
    const uint64_t divisor = power_of_five[-exponent] << divisor_shift;
    /* the quotient fills 64 bits; its last bit also stands for what is left, which is enough
       because only the first 53 bits stay */
    const int up = dividend >= divisor ? 63 : 64;
    const wide shifted = (wide)dividend << up;
    uint64_t quotient = (uint64_t)(shifted / divisor);
    quotient |= (uint64_t)((uint64_t)shifted != quotient * divisor);
    return (double)quotient * power_of_two(divisor_shift - shift - up + exponent);
}
#endif

/* Rounded to nearest, without the sign. *exact tells whether this could be done. */
static double decimal_value(const decimal *number, bool *exact)
{
    *exact = true;
    if (number->digits == 0)
    {
        return 0.0;
    }
#ifdef __SIZEOF_INT128__
    if (number->exact && number->exponent > -POWERS_OF_FIVE && number->exponent < POWERS_OF_FIVE)
    {
        return scale_decimal(number->digits, (int)number->exponent);
    }
#endif
    *exact = false;
    return 0.0;
}

const char *number_read(const char *text, const char *end, double *value)
{
    decimal number = {0, 0, 0, true, false};
    const char *at = text;

    if (at < end && (*at == '-' || *at == '+'))
    {
        number.negative = *at == '-';
        at++;
    }
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
        return read_word(whole, end, number.negative, value);
    }
    at = take_exponent(at, end, &number);
    if (at - text > NUMBER_READ_MAX)
    {
        return NULL;
    }
    bool exact;
    const double magnitude = decimal_value(&number, &exact);
    *value = !exact ? read_with_strtod(text, at) : number.negative ? -magnitude : magnitude;
    return at;
}

/* ------------------------------------------------------------------------------- writing */

/* printf, and the locale's decimal mark made a point again. */
static size_t write_with_printf(double value, int digits, char text[NUMBER_WRITE_MAX])
{
    char copy[NUMBER_WRITE_MAX + 16];
    const char *const mark = localeconv()->decimal_point;
    const int length = snprintf(copy, sizeof copy, "%.*g", digits, value);
    if (length < 0 || (size_t)length >= sizeof copy)
    {
        text[0] = '\0';
        return 0;
    }
    const char *const found = strcmp(mark, ".") == 0 ? NULL : strstr(copy, mark);
    if (found == NULL)
    {
        memcpy(text, copy, (size_t)length + 1);
        return (size_t)length;
    }
    const size_t before = (size_t)(found - copy);
    const char *const behind = found + strlen(mark);
    memcpy(text, copy, before);
    text[before] = '.';
    memcpy(text + before + 1, behind, strlen(behind) + 1);
    return before + 1 + strlen(behind);
}

#ifdef __SIZEOF_INT128__
/* The whole number nearest to significand * 2^exponent * 10^scale, ties to even; scale is in
 * [0, 32]. The result must be below 2^63. */
static uint64_t round_scaled(uint64_t significand, int exponent, int scale)
{
    const int first = scale < POWERS_OF_FIVE ? scale : POWERS_OF_FIVE - 1;
    /* below 2^53 * 5^32 < 2^128 */
    const wide product = (wide)significand * power_of_five[first] * power_of_five[scale - first];
    const int right = -(exponent + scale);
    if (right <= 0)
    {
        return (uint64_t)product << -right;
    }
    const wide half = (wide)1 << (right - 1);
    const wide rest = product & (((wide)1 << right) - 1);
    const uint64_t floored = (uint64_t)(product >> right);
    return floored + (uint64_t)(rest > half || (rest == half && (floored & 1) != 0));
}

/* The first digits of a positive value, rounded to nearest, as a whole number in
 * [10^(digits - 1), 10^digits), and the power of ten of the first of them. False if the value is
 * too large or too small for 128 bits. */
static bool find_digits(double value, int digits, uint64_t *decimal_digits, int *first_power)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const int exponent = (int)(bits >> 52) - 1075;
    const uint64_t significand = (bits & ((1ULL << 52) - 1)) | (1ULL << 52);

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
            *decimal_digits = rounded;
            *first_power = power;
            return true;
        }
        /* 9.99... that rounds up to 10 is found again as 1.00 with the next power */
    }
    return false;
}

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
static int write_digits(uint64_t value, int digits, char text[NUMBER_DIGITS_MAX])
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

/* Lay digits out as %g does for that precision; power is that of the first digit and lies in
 * (-100, 100). */
static char *lay_out(const char *digits, int count, int power, int precision, char *text)
{
    if (power >= 0 && power < precision)
    {
        const int whole = power + 1;
        const int present = count < whole ? count : whole;
        memcpy(text, digits, (size_t)present);
        memset(text + present, '0', (size_t)(whole - present));
        text += whole;
        digits += present;
        count -= present;
        if (count > 0)
        {
            *text++ = '.';
        }
    }
    else if (power >= -4 && power < 0)
    {
        memcpy(text, "0.0000", 6);
        text += 1 - power;
    }
    else
    {
        *text++ = *digits++;
        count--;
        if (count > 0)
        {
            *text++ = '.';
        }
        memcpy(text, digits, (size_t)count);
        text += count;
        const int magnitude = power < 0 ? -power : power;
        *text++ = 'e';
        *text++ = power < 0 ? '-' : '+';
        *text++ = (char)('0' + magnitude / 10);
        *text++ = (char)('0' + magnitude % 10);
        return text;
    }
    memcpy(text, digits, (size_t)count);
    return text + count;
}
#endif

size_t number_write(double value, int digits, char text[NUMBER_WRITE_MAX])
{
    if (isnan(value))
    {
        memcpy(text, "nan", 4);
        return 3;
    }
    if (value == 0)
    {
        memcpy(text, "0", 2);
        return 1;
    }
#ifdef __SIZEOF_INT128__
    uint64_t decimal_digits;
    int power;
    /* the bounds only keep the estimate's arithmetic in its range; find_digits has the real ones */
    const double magnitude = fabs(value);
    if (magnitude > 1e-40 && magnitude < 1e20 &&
        find_digits(magnitude, digits, &decimal_digits, &power))
    {
        char significant[NUMBER_DIGITS_MAX];
        const int count = write_digits(decimal_digits, digits, significant);
        char *at = text;
        *at = '-';
        at += value < 0;
        at = lay_out(significant, count, power, digits, at);
        *at = '\0';
        return (size_t)(at - text);
    }
#endif
    return write_with_printf(value, digits, text);
}

size_t number_write_shortest(double value, char text[NUMBER_WRITE_MAX])
{
    for (int digits = 15; digits < NUMBER_DIGITS_MAX; digits++)
    {
        double again;
        const size_t length = number_write(value, digits, text);
        if (number_read(text, text + length, &again) != NULL && again == value)
        {
            return length;
        }
    }
    return number_write(value, NUMBER_DIGITS_MAX, text);
}
