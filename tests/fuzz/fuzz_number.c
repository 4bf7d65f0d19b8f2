/* SPDX-License-Identifier: MIT
 *
 * Decimal numbers against the C library's: the input as text, and its bytes as doubles.
 */
#include "tools/cli/number_word.h"

#include <cubemap/number.h>

#include <ctype.h>
#include <math.h>
#include <strings.h>

#include "fuzz.h"

/* The same digits, of a size that the quick ways of reading and writing take. */
static double middling(double value)
{
    int exponent;
    double part = frexp(value, &exponent);
    return isfinite(value) ? ldexp(part, exponent % 128) : value;
}

static int same(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

/* Does strtod read something here that is no number here? */
static int is_foreign(const char *text)
{
    size_t sign = *text == '-' || *text == '+' ? 1 : 0;
    return isspace((unsigned char)*text) ||
           (text[sign] == '0' && (text[sign + 1] == 'x' || text[sign + 1] == 'X')) ||
           strncasecmp(text + sign, "nan(", 4) == 0;
}

/* bytes ends where its memory ends; text is the same with a zero byte. */
static void check_read(const char *bytes, size_t size, const char *text)
{
    double value = 77.0;
    char *end;
    const char *after = number_or_word(bytes, bytes + size, &value);
    double digits = 77.0;
    size_t count = cm_number_read(bytes, size, &digits);
    double expected = strtod(text, &end);
    if (after == NULL)
    {
        EXPECT(same(value, 77.0), "no number, but a value");
        EXPECT(end == text || is_foreign(text), "'%s' is %g", text, expected);
        EXPECT(count == 0 && same(digits, 77.0), "no number, but a value");
        return;
    }
    EXPECT(count == 0 || (bytes + count == after && same(digits, value)), "%zu bytes", count);
    EXPECT(cm_number_parse(bytes, size, &digits) == (count > 0 && count == size), "the whole text");
    if (!is_foreign(text))
    {
        EXPECT(after - bytes == end - text, "%td characters of '%s', not %td", after - bytes, text,
               end - text);
        EXPECT(same(value, expected), "'%s' is %a, not %a", text, value, expected);
    }
}

static void check_write(double value, int digits)
{
    char text[CM_NUMBER_SIZE];
    char expected[64];
    double again = 0.0;
    size_t length = cm_number_write(value, digits, text);
    snprintf(expected, sizeof expected, "%.*g", digits, value == 0.0 ? 0.0 : value);
    EXPECT(strlen(text) == length, "%a to %d digits: length %zu of '%s'", value, digits, length,
           text);
    EXPECT(strcmp(text, isnan(value) ? "nan" : expected) == 0, "%a to %d digits: '%s', not '%s'",
           value, digits, text, expected);
    EXPECT(cm_number_parse(text, length, &again) || !isfinite(value), "'%s' is not read", text);
    EXPECT(!isfinite(value) || digits < CM_NUMBER_DIGITS || same(again, value + 0.0),
           "%a comes back as %a", value, again);
    length = cm_number_write_shortest(value, text);
    EXPECT(!isfinite(value) || (cm_number_parse(text, length, &again) && same(again, value + 0.0)),
           "%a comes back from '%s' as %a", value, text, again);
}

/* Between a double and the next, where reading must round right, with so many digits. */
static void check_read_halfway(double value, int digits)
{
    char text[64];
    long double halfway = (value + (long double)nextafter(value, INFINITY)) / 2.0L;
    int length = snprintf(text, sizeof text, "%.*Lg", digits, halfway);
    char *bytes = malloc((size_t)length);
    EXPECT(bytes != NULL, "no memory");
    memcpy(bytes, text, (size_t)length);
    check_read(bytes, (size_t)length, text);
    free(bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    supply from = {data, size};
    supply again = {data, size};
    char *text = take_text(&from);
    check_read((const char *)data, size, text);
    free(text);
    while (again.left > 0)
    {
        int digits = 1 + take_byte(&again) % CM_NUMBER_DIGITS;
        double value = take_double(&again);
        check_write(value, digits);
        check_write(middling(value), digits);
        check_read_halfway(middling(value), 14 + digits % 8);
    }
    return 0;
}
