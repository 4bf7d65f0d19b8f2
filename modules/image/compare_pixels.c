/* SPDX-License-Identifier: MIT */
#include "compare_pixels.h"

#include <math.h>
#include <string.h>

#include "half.h"

int cm_compare_is_whole(cm_pixel_type type)
{
    return type == CM_PIXEL_U8 || type == CM_PIXEL_U16;
}

int cm_compare_options_of(const cm_compare_options *given, cm_compare_options *options)
{
    static const cm_compare_options standard = {.size = sizeof standard};
    *options = given == NULL ? standard : *given;
    if (options->size != sizeof *options || options->not_finite < CM_COMPARE_REFUSE ||
        options->not_finite > CM_COMPARE_ALIKE ||
        !(options->peak == 0.0 || (options->peak >= 1e-100 && options->peak <= 1e100)))
    {
        return 0;
    }
    if (options->pixels_per_degree == 0.0)
    {
        options->pixels_per_degree = CM_FLIP_PIXELS_PER_DEGREE;
    }
    return options->pixels_per_degree >= 0.01 && options->pixels_per_degree <= 1000.0 &&
           options->exposure_count <= CM_FLIP_EXPOSURES_MAX && isfinite(options->exposure_start) &&
           isfinite(options->exposure_stop) && options->exposure_start <= options->exposure_stop;
}

/* ---- what pictures are ---- */

cm_status cm_compare_image(const cm_image *given, cm_image *image)
{
    if (given == NULL || given->size != sizeof *given || given->data == NULL ||
        cm_pixel_size(given->type) == 0 || given->width == 0 || given->height == 0 ||
        given->channels == 0 || given->channels > CM_CHANNELS_MAX)
    {
        return CM_ERROR_ARGUMENT;
    }
    const ptrdiff_t pixel = (ptrdiff_t)(given->channels * cm_pixel_size(given->type));
    *image = *given;
    image->pixel_stride = given->pixel_stride == 0 ? pixel : given->pixel_stride;
    const ptrdiff_t step = image->pixel_stride < 0 ? -image->pixel_stride : image->pixel_stride;
    if (image->row_stride == 0)
    {
        if (step > PTRDIFF_MAX / (ptrdiff_t)given->width)
        {
            return CM_ERROR_ARGUMENT;
        }
        image->row_stride = step * (ptrdiff_t)given->width;
    }
    return CM_OK;
}

static int is_alike(const cm_image *one, const cm_image *other)
{
    return one->width == other->width && one->height == other->height &&
           one->channels == other->channels;
}

static cm_status check_weights(const cm_compare_pair *pair)
{
    double weights[256];
    for (uint32_t row = 0; row < pair->weights.height; row++)
    {
        for (uint32_t column = 0; column < pair->weights.width; column += 256)
        {
            const uint32_t left = pair->weights.width - column;
            const size_t count = left < 256 ? left : 256;
            cm_compare_read(&pair->weights, row, column, count, 0, weights);
            for (size_t i = 0; i < count; i++)
            {
                if (!(weights[i] >= 0.0) || isinf(weights[i]))
                {
                    return CM_ERROR_RANGE;
                }
            }
        }
    }
    return CM_OK;
}

cm_status cm_compare_pair_of(const cm_image *reference, const cm_image *picture,
                             const cm_image *weights, cm_compare_pair *pair)
{
    if (cm_compare_image(reference, &pair->reference) != CM_OK ||
        cm_compare_image(picture, &pair->picture) != CM_OK)
    {
        return CM_ERROR_ARGUMENT;
    }
    pair->has_weights = weights != NULL;
    if (weights != NULL && (cm_compare_image(weights, &pair->weights) != CM_OK ||
                            weights->type != CM_PIXEL_FLOAT || weights->channels != 1))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!is_alike(reference, picture))
    {
        return CM_ERROR_RANGE;
    }
    if (weights == NULL)
    {
        return CM_OK;
    }
    if (weights->height != picture->height ||
        (weights->width != picture->width && weights->width != 1))
    {
        return CM_ERROR_RANGE;
    }
    return check_weights(pair);
}

cm_status cm_compare_map(const cm_image *given, const cm_image *like, cm_image *map)
{
    if (cm_compare_image(given, map) != CM_OK || map->type != CM_PIXEL_FLOAT || map->channels != 1)
    {
        return CM_ERROR_ARGUMENT;
    }
    return map->width == like->width && map->height == like->height ? CM_OK : CM_ERROR_RANGE;
}

cm_status cm_compare_request_of(const cm_image *reference, const cm_image *picture,
                                const cm_compare_options *options, const cm_map_figures *figures,
                                const cm_image *map, cm_compare_request *request)
{
    if (!cm_compare_options_of(options, &request->options) ||
        request->options.not_finite == CM_COMPARE_ALIKE ||
        (figures != NULL && figures->size != sizeof *figures))
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status =
        cm_compare_pair_of(reference, picture, request->options.weights, &request->pair);
    request->map_wanted = map != NULL ? &request->map : NULL;
    return status == CM_OK && map != NULL
               ? cm_compare_map(map, &request->pair.picture, &request->map)
               : status;
}

/* ---- pixels as numbers ---- */

static unsigned char *place(const cm_image *image, uint64_t row, uint32_t column, uint32_t channel)
{
    return (unsigned char *)image->data + (ptrdiff_t)row * image->row_stride +
           (ptrdiff_t)column * image->pixel_stride +
           (ptrdiff_t)(channel * cm_pixel_size(image->type));
}

void cm_compare_read(const cm_image *image, uint64_t row, uint32_t column, size_t count,
                     uint32_t channel, double *values)
{
    const unsigned char *from = place(image, row, column, channel);
    const ptrdiff_t step = image->pixel_stride;
    switch (image->type)
    {
    case CM_PIXEL_U8:
        for (size_t i = 0; i < count; i++)
        {
            values[i] = from[(ptrdiff_t)i * step] / 255.0;
        }
        break;
    case CM_PIXEL_U16:
        for (size_t i = 0; i < count; i++)
        {
            values[i] = *(const uint16_t *)(const void *)(from + (ptrdiff_t)i * step) / 65535.0;
        }
        break;
    case CM_PIXEL_HALF:
        for (size_t i = 0; i < count; i++)
        {
            values[i] = (double)cm_float_of_half(
                *(const uint16_t *)(const void *)(from + (ptrdiff_t)i * step));
        }
        break;
    default:
        for (size_t i = 0; i < count; i++)
        {
            values[i] = (double)*(const float *)(const void *)(from + (ptrdiff_t)i * step);
        }
        break;
    }
}

static double unit(double value)
{
    return value > 0.0 ? (value < 1.0 ? value : 1.0) : 0.0;
}

void cm_compare_write(const cm_image *image, uint64_t row, uint32_t column, size_t count,
                      uint32_t channel, const double *values)
{
    unsigned char *to = place(image, row, column, channel);
    for (size_t i = 0; i < count; i++, to += image->pixel_stride)
    {
        switch (image->type)
        {
        case CM_PIXEL_U8:
            *to = (uint8_t)(unit(values[i]) * 255.0 + 0.5);
            break;
        case CM_PIXEL_U16:
            *(uint16_t *)(void *)to = (uint16_t)(unit(values[i]) * 65535.0 + 0.5);
            break;
        case CM_PIXEL_HALF:
            *(uint16_t *)(void *)to = cm_half_of_float((float)values[i]);
            break;
        default:
            *(float *)(void *)to = (float)values[i];
            break;
        }
    }
}

void cm_compare_read_weights(const cm_compare_pair *pair, uint64_t row, uint32_t column,
                             size_t count, double *weights)
{
    if (pair->has_weights && pair->weights.width > 1)
    {
        cm_compare_read(&pair->weights, row, column, count, 0, weights);
        return;
    }
    double weight = 1.0;
    if (pair->has_weights)
    {
        cm_compare_read(&pair->weights, row, 0, 1, 0, &weight);
    }
    for (size_t i = 0; i < count; i++)
    {
        weights[i] = weight;
    }
}
