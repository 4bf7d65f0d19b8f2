/* SPDX-License-Identifier: MIT
 *
 * Coefficients as JSON.
 */
#include <cubemap/environment.h>

#include <cubemap/number.h>

#include <math.h>
#include <string.h>

/* What is written, and how long it would be. */
typedef struct text_end
{
    char *text;
    size_t size;
    size_t length;
} text_end;

static void add_bytes(text_end *end, const char *bytes, size_t count)
{
    if (end->length < end->size && count < end->size - end->length)
    {
        memcpy(end->text + end->length, bytes, count);
    }
    end->length += count;
}

static void add_text(text_end *end, const char *text)
{
    add_bytes(end, text, strlen(text));
}

static void add_number(text_end *end, double value)
{
    char digits[CM_NUMBER_SIZE];
    const size_t length = cm_number_write_shortest(value, digits);
    add_bytes(end, digits, length);
}

static void add_all(text_end *end, uint32_t degree, uint32_t channels, const double *coefficients)
{
    add_text(end, "{\"degree\": ");
    add_number(end, degree);
    add_text(end, ", \"channels\": ");
    add_number(end, channels);
    add_text(end, ", \"index\": \"l(l+1)+m\", "
                  "\"basis\": \"real orthonormal without Condon-Shortley phase\", "
                  "\"coefficients\": [");
    const size_t count = cm_harmonics_count(degree);
    for (size_t k = 0; k < count; k++)
    {
        add_text(end, k == 0 ? "\n  [" : ",\n  [");
        for (uint32_t c = 0; c < channels; c++)
        {
            add_text(end, c == 0 ? "" : ", ");
            add_number(end, coefficients[k * channels + c]);
        }
        add_text(end, "]");
    }
    add_text(end, "]}\n");
}

cm_status cm_harmonics_json(uint32_t degree, uint32_t channels, const double *coefficients,
                            char *text, size_t size, size_t *length)
{
    if (coefficients == NULL || length == NULL || (text == NULL && size > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (degree > CM_HARMONICS_DEGREE_MAX || channels < 1 || channels > CM_ENVIRONMENT_CHANNELS_MAX)
    {
        return CM_ERROR_RANGE;
    }
    const size_t count = cm_harmonics_count(degree) * channels;
    for (size_t k = 0; k < count; k++)
    {
        if (!isfinite(coefficients[k]))
        {
            return CM_ERROR_RANGE;
        }
    }
    /* outputs stay as they are on failure, so that the length comes first */
    text_end measure = {NULL, 0, 0};
    add_all(&measure, degree, channels, coefficients);
    *length = measure.length;
    if (measure.length >= size)
    {
        return CM_ERROR_SPACE;
    }
    text_end end = {text, size, 0};
    add_all(&end, degree, channels, coefficients);
    text[end.length] = '\0';
    return CM_OK;
}
