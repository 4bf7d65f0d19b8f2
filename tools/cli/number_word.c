/* SPDX-License-Identifier: MIT */
#include "number_word.h"

#include <cubemap/number.h>

#include <math.h>
#include <stdbool.h>

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

const char *number_or_word(const char *text, const char *end, double *value)
{
    const size_t count = cm_number_read(text, (size_t)(end - text), value);
    const bool has_sign = text < end && (*text == '-' || *text == '+');
    return count > 0 ? text + count
                     : read_word(text + has_sign, end, has_sign && *text == '-', value);
}
