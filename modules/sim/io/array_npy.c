/* SPDX-License-Identifier: MIT */
#include "array_file.h"

#include "modules/image/io/npy_head.h"

#include <stdio.h>

/* As NumPy names them, by the order of their bytes. */
static const char *const little[] = {"|u1", "<u4", "<f4", "<f8"};
static const char *const big[] = {"|u1", ">u4", ">f4", ">f8"};

static int is_little(void)
{
    const uint16_t one = 1;
    return *(const unsigned char *)&one == 1;
}

cm_status cm_array_write_npy(const cm_image_stream *stream, const cm_array *array, char *message)
{
    const size_t bytes = cm_array_bytes(array);
    char head[CM_NPY_HEAD];
    if (stream == NULL || bytes == 0)
    {
        if (message != NULL)
        {
            snprintf(message, CM_IMAGE_MESSAGE, "%s", cm_status_text(CM_ERROR_ARGUMENT));
        }
        return CM_ERROR_ARGUMENT;
    }
    const char *const type = is_little() ? little[array->type] : big[array->type];
    const size_t length = cm_npy_head(type, array->rank, array->shape, head);
    if (stream->write(stream->context, head, length) != length ||
        stream->write(stream->context, array->data, bytes) != bytes)
    {
        if (message != NULL)
        {
            snprintf(message, CM_IMAGE_MESSAGE, "not all bytes of an array could be written");
        }
        return CM_ERROR_FILE;
    }
    return CM_OK;
}
