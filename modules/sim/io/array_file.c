/* SPDX-License-Identifier: MIT */
#include "array_file.h"

static const size_t sizes[] = {1, 4, 4, 8}; /* of types */

size_t cm_array_bytes(const cm_array *array)
{
    if (array == NULL || array->data == NULL ||
        (size_t)array->type >= sizeof sizes / sizeof *sizes || array->rank < 1 ||
        array->rank > CM_ARRAY_RANK)
    {
        return 0;
    }
    size_t bytes = sizes[array->type];
    for (size_t i = 0; i < array->rank; i++)
    {
        if (array->shape[i] == 0 || array->shape[i] > SIZE_MAX / bytes)
        {
            return 0;
        }
        bytes *= (size_t)array->shape[i];
    }
    return bytes;
}
