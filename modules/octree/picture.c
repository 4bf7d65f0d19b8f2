/* SPDX-License-Identifier: MIT */
#include "picture.h"

#include <string.h>

cm_status cm_picture_check(const cm_image *image, uint32_t width, uint32_t height, uint32_t least,
                           uint32_t most)
{
    if (image->size != sizeof *image || image->data == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    const int fits = image->width == width && image->height == height && image->channels >= least &&
                     image->channels <= most && cm_pixel_size(image->type) != 0;
    return fits ? CM_OK : CM_ERROR_RANGE;
}

void *cm_picture_at(const cm_image *image, size_t column, size_t row)
{
    const ptrdiff_t dense = (ptrdiff_t)(cm_pixel_size(image->type) * image->channels);
    const ptrdiff_t pixel = image->pixel_stride == 0 ? dense : image->pixel_stride;
    const ptrdiff_t rows =
        image->row_stride == 0 ? pixel * (ptrdiff_t)image->width : image->row_stride;
    return (char *)image->data + rows * (ptrdiff_t)row + pixel * (ptrdiff_t)column;
}

static float within_one(float value)
{
    return value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
}

void cm_picture_write(const cm_image *image, size_t column, size_t row, const float *value,
                      uint32_t channels)
{
    void *pixel = cm_picture_at(image, column, row);
    for (uint32_t c = 0; c < channels; c++)
    {
        const float one = within_one(value[c]);
        if (image->type == CM_PIXEL_U8)
        {
            ((uint8_t *)pixel)[c] = (uint8_t)(one * 255.0f + 0.5f);
        }
        else if (image->type == CM_PIXEL_U16)
        {
            ((uint16_t *)pixel)[c] = (uint16_t)(one * 65535.0f + 0.5f);
        }
        else
        {
            ((float *)pixel)[c] = value[c];
        }
    }
}

int cm_picture_is_set(const cm_image *image, size_t column, size_t row)
{
    const void *pixel = cm_picture_at(image, column, row);
    int is_set = 0;
    for (uint32_t c = 0; c < image->channels; c++)
    {
        switch (image->type)
        {
        case CM_PIXEL_U8:
            is_set |= ((const uint8_t *)pixel)[c] != 0;
            break;
        case CM_PIXEL_U16:
            is_set |= ((const uint16_t *)pixel)[c] != 0;
            break;
        case CM_PIXEL_HALF:
            is_set |= (((const uint16_t *)pixel)[c] & 0x7fff) != 0;
            break;
        default:
            is_set |= ((const float *)pixel)[c] != 0.0f;
        }
    }
    return is_set;
}
