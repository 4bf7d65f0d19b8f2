/* SPDX-License-Identifier: MIT */
#include "environment_pixels.h"

#include <cubemap/environment.h>

#include <math.h>
#include <string.h>

#include "half.h"

cm_status cm_pixels_check(const cm_image *image, uint32_t channels_most)
{
    if (image == NULL || image->size != sizeof *image || image->data == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const int is_type = (int)image->type >= CM_PIXEL_U8 && (int)image->type <= CM_PIXEL_FLOAT;
    if (!is_type || image->channels < 1 || image->channels > channels_most || image->width < 1 ||
        image->width > CM_ENVIRONMENT_SIZE_MAX || image->height < 1 ||
        image->height > CM_ENVIRONMENT_SIZE_MAX)
    {
        return CM_ERROR_RANGE;
    }
    return CM_OK;
}

cm_status cm_faces_check(const cm_mapping *mapping, const cm_image *faces)
{
    if (mapping == NULL || faces == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (cm_mapping_describe(mapping)->kind != CM_KIND_CUBE)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    for (size_t i = 0; i < 6; i++)
    {
        const cm_status status = cm_pixels_check(&faces[i], CM_ENVIRONMENT_CHANNELS_MAX);
        if (status != CM_OK)
        {
            return status;
        }
        if (faces[i].width != faces[0].width || faces[i].height != faces[0].width ||
            faces[i].type != faces[0].type || faces[i].channels != faces[0].channels)
        {
            return CM_ERROR_RANGE;
        }
    }
    return CM_OK;
}

static unsigned char *address(const cm_image *image, uint32_t row, uint32_t column)
{
    const ptrdiff_t dense = (ptrdiff_t)(image->channels * cm_pixel_size(image->type));
    const ptrdiff_t across = image->pixel_stride != 0 ? image->pixel_stride : dense;
    const ptrdiff_t down =
        image->row_stride != 0 ? image->row_stride : across * (ptrdiff_t)image->width;
    return (unsigned char *)image->data + (ptrdiff_t)row * down + (ptrdiff_t)column * across;
}

/* ---- pixels ---- */

void cm_pixel_load(const cm_image *image, uint32_t row, uint32_t column, float *value)
{
    const unsigned char *from = address(image, row, column);
    for (uint32_t c = 0; c < image->channels; c++)
    {
        uint16_t number = 0;
        switch (image->type)
        {
        case CM_PIXEL_U8:
            value[c] = (float)from[c] / 255.0F;
            break;
        case CM_PIXEL_U16:
            memcpy(&number, from + 2 * (size_t)c, 2);
            value[c] = (float)number / 65535.0F;
            break;
        case CM_PIXEL_HALF:
            memcpy(&number, from + 2 * (size_t)c, 2);
            value[c] = cm_float_of_half(number);
            break;
        case CM_PIXEL_FLOAT:
            memcpy(&value[c], from + 4 * (size_t)c, 4);
            break;
        }
    }
}

static uint16_t whole(float value, float most)
{
    const float in = value > 0.0F ? fminf(value, 1.0F) : 0.0F;
    return (uint16_t)(in * most + 0.5F);
}

void cm_pixel_store(const cm_image *image, uint32_t row, uint32_t column, const float *value)
{
    unsigned char *to = address(image, row, column);
    for (uint32_t c = 0; c < image->channels; c++)
    {
        uint16_t number = 0;
        switch (image->type)
        {
        case CM_PIXEL_U8:
            to[c] = (unsigned char)whole(value[c], 255.0F);
            break;
        case CM_PIXEL_U16:
            number = whole(value[c], 65535.0F);
            memcpy(to + 2 * (size_t)c, &number, 2);
            break;
        case CM_PIXEL_HALF:
            number = cm_half_of_float(value[c]);
            memcpy(to + 2 * (size_t)c, &number, 2);
            break;
        case CM_PIXEL_FLOAT:
            memcpy(to + 4 * (size_t)c, &value[c], 4);
            break;
        }
    }
}

uint32_t cm_face_row(const cm_mapping *mapping, uint32_t size, uint32_t row)
{
    return cm_mapping_frame(mapping)->first_row_v < 0 ? row : size - 1 - row;
}
