/* SPDX-License-Identifier: MIT */
#include "known_digits.h"

#include <math.h>
#include <stdio.h>

int known_decimals(double error, int most)
{
    int decimals = -1;
    double half = 0.5;
    while (decimals < most && error <= half)
    {
        decimals++;
        half /= 10.0;
    }
    return decimals;
}

const char *known_text(double value, double error, int most, char text[KNOWN_TEXT_SIZE])
{
    int decimals = known_decimals(error, most);
    if (isinf(value))
    {
        snprintf(text, KNOWN_TEXT_SIZE, value > 0.0 ? "inf" : "-inf");
    }
    else if (isnan(value) || decimals < 0)
    {
        snprintf(text, KNOWN_TEXT_SIZE, "-");
    }
    else
    {
        snprintf(text, KNOWN_TEXT_SIZE, "%.*f", decimals, value);
    }
    return text;
}
