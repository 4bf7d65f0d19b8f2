/* SPDX-License-Identifier: MIT
 *
 * Decimal numbers in specifications. strtod and snprintf round correctly, but write and read the point as
 * the locale of the program has it; so it is put in and taken out here.
 */
#include "colormap_number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TEXT_MAX 100

/* What stands between the digits of 0.5 in this locale; its length. */
static size_t locale_point(char point[CM_COLORMAP_NUMBER_MAX])
{
    char text[CM_COLORMAP_NUMBER_MAX];
    const int length = snprintf(text, sizeof text, "%.1f", 0.5);
    const size_t size = length > 2 && (size_t)length < sizeof text ? (size_t)length - 2 : 0;
    memcpy(point, text + 1, size);
    return size;
}

static size_t count_digits(const char *text, const char *end)
{
    size_t count = 0;
    while (text + count < end && text[count] >= '0' && text[count] <= '9')
    {
        count++;
    }
    return count;
}

static size_t count_sign(const char *text, const char *end)
{
    return text < end && (*text == '-' || *text == '+') ? 1 : 0;
}

/* [+-]DIGITS[.DIGITS][e[+-]DIGITS], digits before or after the point? *point is the point, or NULL. */
static int is_number(const char *text, const char *end, const char **point)
{
    const char *at = text + count_sign(text, end);
    size_t digits = count_digits(at, end);
    at += digits;
    *point = at < end && *at == '.' ? at : NULL;
    if (*point != NULL)
    {
        const size_t behind = count_digits(at + 1, end);
        at += 1 + behind;
        digits += behind;
    }
    if (digits > 0 && at < end && (*at == 'e' || *at == 'E'))
    {
        at += 1 + count_sign(at + 1, end);
        digits = count_digits(at, end);
        at += digits;
    }
    return digits > 0 && at == end;
}

int cm_colormap_number_read(const char *text, size_t length, double *value)
{
    char changed[TEXT_MAX + CM_COLORMAP_NUMBER_MAX];
    const char *point;
    if (length > TEXT_MAX || !is_number(text, text + length, &point))
    {
        return 0;
    }
    const size_t before = point == NULL ? length : (size_t)(point - text);
    memcpy(changed, text, before);
    size_t at = before;
    if (point != NULL)
    {
        at += locale_point(changed + at);
        memcpy(changed + at, point + 1, length - before - 1);
        at += length - before - 1;
    }
    changed[at] = '\0';
    *value = strtod(changed, NULL) + 0.0; /* + 0.0 makes -0 to 0 */
    return 1;
}

void cm_colormap_number_write(double value, char text[CM_COLORMAP_NUMBER_MAX])
{
    char point[CM_COLORMAP_NUMBER_MAX];
    double again = value + 1.0;
    for (int digits = 15; digits <= 17 && again != value; digits++)
    {
        snprintf(text, CM_COLORMAP_NUMBER_MAX, "%.*g", digits, value);
        again = strtod(text, NULL);
    }
    const size_t size = locale_point(point);
    point[size] = '\0';
    char *found = strstr(text, point);
    if (size > 0 && found != NULL)
    {
        *found = '.';
        memmove(found + 1, found + size, strlen(found + size) + 1);
    }
}
