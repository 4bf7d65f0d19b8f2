/* SPDX-License-Identifier: MIT
 *
 * Decimal numbers in the texts that the library reads. Not strtod, which reads a comma where the locale of
 * the program has one.
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "number_text.h"

#include <stdlib.h>

/* The digits of a number, with or without a point, up to anything else; *text is moved there. The
 * value is *digits times a power of ten, which is returned; digits beyond the 19th only count. */
static int scan_digits(const char **text, const char *end, unsigned long long *digits, int *count)
{
    int power = 0;
    int point = 0;
    for (; *text < end; ++*text)
    {
        char c = **text;
        if (c == '.' && !point)
        {
            point = 1;
        }
        else if (c >= '0' && c <= '9')
        {
            int kept = *digits < 1000000000000000000ull;
            *digits = kept ? *digits * 10 + (unsigned)(c - '0') : *digits;
            power += (kept ? 0 : 1) - point;
            ++*count;
        }
        else
        {
            break;
        }
    }
    return power;
}

/* What follows an e; 0 if it is no exponent. */
static int scan_exponent(const char **text, const char *end, int *power)
{
    int sign = 1;
    int value = 0;
    int count = 0;
    if (*text < end && (**text == '-' || **text == '+'))
    {
        sign = **text == '-' ? -1 : 1;
        ++*text;
    }
    for (; *text < end && **text >= '0' && **text <= '9'; ++*text, count++)
    {
        value = value < 100000 ? value * 10 + (**text - '0') : value;
    }
    *power += sign * value;
    return count > 0;
}

/* digits * 10^power. Correctly rounded for up to 15 digits and powers to 22, where both operands are
 * exact (Clinger 1990); else within an ulp. Out of range it is infinite or 0, not an error: the
 * parameters' ranges say what is right. */
static double scale_by_ten(unsigned long long digits, int power)
{
    const int exact = digits <= 0x20000000000000ull && power >= -22 && power <= 22;
    const int most = 400; /* beyond the range of double, with 19 digits too */
    long double scale = 1.0L;
    for (int i = abs(power) < most ? abs(power) : most; i > 0; i--)
    {
        scale *= 10.0L;
    }
    if (exact)
    {
        return power < 0 ? (double)digits / (double)scale : (double)digits * (double)scale;
    }
    return (double)(power < 0 ? (long double)digits / scale : (long double)digits * scale);
}

int cm_number_parse(const char *text, size_t length, double *value)
{
    const char *end = text + length;
    unsigned long long digits = 0;
    int count = 0;
    int negative = length > 0 && *text == '-';
    text += length > 0 && (*text == '-' || *text == '+') ? 1 : 0;
    int power = scan_digits(&text, end, &digits, &count);
    if (count > 0 && text < end && (*text == 'e' || *text == 'E'))
    {
        ++text;
        count = scan_exponent(&text, end, &power) ? count : 0;
    }
    if (count == 0 || text != end)
    {
        return 0;
    }
    *value = scale_by_ten(digits, power);
    *value = negative ? -*value : *value;
    return 1;
}
