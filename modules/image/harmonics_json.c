/* SPDX-License-Identifier: MIT
 *
 * Coefficients as JSON.
 */
#include <cubemap/environment.h>

#include <math.h>

#include "text_end.h"

static void add_all(cm_text_end *end, uint32_t degree, uint32_t channels,
                    const double *coefficients)
{
    cm_text_add(end, "{\"degree\": ");
    cm_text_add_number(end, degree);
    cm_text_add(end, ", \"channels\": ");
    cm_text_add_number(end, channels);
    cm_text_add(end, ", \"index\": \"l(l+1)+m\", "
                     "\"basis\": \"real orthonormal without Condon-Shortley phase\", "
                     "\"coefficients\": [");
    const size_t count = cm_harmonics_count(degree);
    for (size_t k = 0; k < count; k++)
    {
        cm_text_add(end, k == 0 ? "\n  [" : ",\n  [");
        for (uint32_t c = 0; c < channels; c++)
        {
            cm_text_add(end, c == 0 ? "" : ", ");
            cm_text_add_number(end, coefficients[k * channels + c]);
        }
        cm_text_add(end, "]");
    }
    cm_text_add(end, "]}\n");
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
    cm_text_end measure = {NULL, 0, 0};
    add_all(&measure, degree, channels, coefficients);
    *length = measure.length;
    if (measure.length >= size)
    {
        return CM_ERROR_SPACE;
    }
    cm_text_end end = {text, size, 0};
    add_all(&end, degree, channels, coefficients);
    return CM_OK;
}
