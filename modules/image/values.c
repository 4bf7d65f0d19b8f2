/* SPDX-License-Identifier: MIT */
#include "values.h"

#include <cubemap/srgb.h>

#include <math.h>
#include <string.h>

#include "half.h"

/* ---- transfer, mirrored for negative values ---- */

static float light_of(const cm_values *values, float stored)
{
    return values->transfer == CM_TRANSFER_GAMMA
               ? copysignf(powf(fabsf(stored), (float)values->gamma), stored)
               : cm_light_from_srgb_float(stored);
}

static float stored_of(const cm_values *values, float light)
{
    return values->transfer == CM_TRANSFER_GAMMA
               ? copysignf(powf(fabsf(light), (float)(1.0 / values->gamma)), light)
               : cm_srgb_from_light_float(light);
}

/* ---- one pixel ---- */

static float read_channel(cm_pixel_type type, const unsigned char *from, uint32_t channel)
{
    uint16_t word;
    float value;
    switch (type)
    {
    case CM_PIXEL_U8:
        return (float)from[channel] * (1.0f / 255.0f);
    case CM_PIXEL_U16:
        memcpy(&word, from + 2 * channel, sizeof word);
        return (float)word * (1.0f / 65535.0f);
    case CM_PIXEL_HALF:
        memcpy(&word, from + 2 * channel, sizeof word);
        return cm_float_of_half(word);
    default:
        memcpy(&value, from + 4 * channel, sizeof value);
        return value;
    }
}

static int is_vector(const cm_values *values, uint32_t channel)
{
    return values->vector != 0 && channel + 1 >= values->vector && channel < values->vector + 2;
}

/* Whole numbers hold a vector as normal maps do: 0 to 1 stands for -1 to 1. */
static int is_coded_vector(const cm_values *values)
{
    return values->vector != 0 && (values->type == CM_PIXEL_U8 || values->type == CM_PIXEL_U16);
}

/* What is added to a component that is coded, multiplied by alpha where that is. */
static float vector_offset(const cm_values *values, const float *pixel)
{
    return values->alpha != 0 && values->alpha_multiplied ? pixel[values->alpha - 1] : 1.0f;
}

static void decode_vector(const cm_values *values, float *pixel)
{
    float *v = pixel + values->vector - 1;
    const float offset = vector_offset(values, pixel);
    for (int i = 0; i < 3; i++)
    {
        v[i] = 2.0f * v[i] - offset;
    }
}

static void encode_vector(const cm_values *values, float *pixel)
{
    float *v = pixel + values->vector - 1;
    const float offset = vector_offset(values, pixel);
    for (int i = 0; i < 3; i++)
    {
        v[i] = 0.5f * (v[i] + offset);
    }
}

/* 0 to most, rounded; what is no number is 0. */
static float whole(float value, float most, float offset)
{
    const float scaled = value * most + 0.5f + offset;
    return scaled > 0.0f ? (scaled < most + 0.5f ? floorf(scaled) : most) : 0.0f;
}

static void write_channel(cm_pixel_type type, float value, float offset, unsigned char *to,
                          uint32_t channel)
{
    uint16_t word;
    switch (type)
    {
    case CM_PIXEL_U8:
        to[channel] = (unsigned char)whole(value, 255.0f, offset);
        return;
    case CM_PIXEL_U16:
        word = (uint16_t)whole(value, 65535.0f, offset);
        memcpy(to + 2 * channel, &word, sizeof word);
        return;
    case CM_PIXEL_HALF:
        word = cm_half_of_float(value);
        memcpy(to + 2 * channel, &word, sizeof word);
        return;
    default:
        memcpy(to + 4 * channel, &value, sizeof value);
    }
}

/* Does each channel count? Puts 0 in place of those that do not. */
static int clean(const cm_values *values, float *pixel)
{
    int good = 1;
    for (uint32_t c = 0; c < values->channels; c++)
    {
        if (!isfinite(pixel[c]))
        {
            good = 0;
        }
    }
    for (uint32_t c = 0; c < values->channels && !good; c++)
    {
        const int drop = values->not_finite == CM_NOT_FINITE_SKIP || !isfinite(pixel[c]);
        pixel[c] = drop ? 0.0f : pixel[c];
    }
    return good;
}

static void load_meaning(const cm_values *values, float *pixel)
{
    const uint32_t alpha = values->alpha;
    for (uint32_t c = 0; c < values->channels; c++)
    {
        if (c + 1 != alpha && values->transfer != CM_TRANSFER_STORED && !is_vector(values, c))
        {
            /* what is multiplied by alpha is so as stored; light is multiplied as light */
            const float opacity = alpha != 0 && values->alpha_multiplied ? pixel[alpha - 1] : 1.0f;
            const float divided = opacity != 0.0f ? pixel[c] / opacity : pixel[c];
            pixel[c] = light_of(values, divided) * opacity;
        }
        if (c + 1 != alpha && alpha != 0 && !values->alpha_multiplied)
        {
            pixel[c] *= pixel[alpha - 1];
        }
    }
}

int cm_values_are_stored(const cm_values *values)
{
    return values->transfer == CM_TRANSFER_STORED &&
           (values->alpha == 0 || values->alpha_multiplied) &&
           values->working == values->channels && !is_coded_vector(values);
}

int cm_values_are_plain(const cm_values *values)
{
    return values->type == CM_PIXEL_FLOAT && cm_values_are_stored(values) &&
           values->not_finite == CM_NOT_FINITE_SPREAD;
}

/* ---- runs of numbers, in loops that compilers make vectors of ---- */

static void load_bytes(const uint8_t *restrict from, size_t n, float *restrict to)
{
    for (size_t i = 0; i < n; i++)
    {
        to[i] = (float)from[i] * (1.0f / 255.0f);
    }
}

static void load_words(const unsigned char *from, size_t n, float *restrict to)
{
    enum
    {
        RUN = 64
    };
    for (size_t begin = 0; begin < n; begin += RUN)
    {
        uint16_t word[RUN];
        const size_t count = n - begin < RUN ? n - begin : RUN;
        memcpy(word, from + begin * sizeof *word, count * sizeof *word);
        for (size_t i = 0; i < count; i++)
        {
            to[begin + i] = (float)word[i] * (1.0f / 65535.0f);
        }
    }
}

/* As whole() rounds without an offset. */
static int32_t rounded(float value, float most)
{
    const float scaled = value * most + 0.5f;
    const float positive = scaled > 0.0f ? scaled : 0.0f;
    return (int32_t)(positive < most + 0.5f ? positive : most);
}

static void store_bytes(const float *restrict from, size_t n, uint8_t *restrict to)
{
    for (size_t i = 0; i < n; i++)
    {
        to[i] = (uint8_t)rounded(from[i], 255.0f);
    }
}

static void store_words(const float *restrict from, size_t n, unsigned char *to)
{
    enum
    {
        RUN = 64
    };
    for (size_t begin = 0; begin < n; begin += RUN)
    {
        uint16_t word[RUN];
        const size_t count = n - begin < RUN ? n - begin : RUN;
        for (size_t i = 0; i < count; i++)
        {
            word[i] = (uint16_t)rounded(from[begin + i], 65535.0f);
        }
        memcpy(to + begin * sizeof *word, word, count * sizeof *word);
    }
}

int cm_values_are_copied(const cm_values *values)
{
    return values->type == CM_PIXEL_FLOAT && cm_values_are_stored(values) && values->vector == 0;
}

/* 1 if the numbers have been stored so: pixels are dense and mean nothing else. */
static int store_dense(const cm_values *values, const float *from, size_t n, void *to,
                       ptrdiff_t stride)
{
    const size_t numbers = n * values->channels;
    const int is_simple = cm_values_are_stored(values) && values->vector == 0 && !values->dither;
    if (cm_values_are_copied(values) && stride == (ptrdiff_t)(4 * values->channels))
    {
        memcpy(to, from, numbers * sizeof *from);
        return 1;
    }
    if (is_simple && values->type == CM_PIXEL_U16 && stride == (ptrdiff_t)(2 * values->channels))
    {
        store_words(from, numbers, to);
        return 1;
    }
    if (is_simple && values->type == CM_PIXEL_U8 && stride == (ptrdiff_t)values->channels)
    {
        store_bytes(from, numbers, to);
        return 1;
    }
    return 0;
}

/* The same for loading. */
static int load_dense(const cm_values *values, const void *from, ptrdiff_t stride, size_t n,
                      float *to)
{
    const size_t numbers = n * values->channels;
    if (cm_values_are_stored(values) && values->type == CM_PIXEL_U16 &&
        stride == (ptrdiff_t)(2 * values->channels))
    {
        load_words(from, numbers, to);
        return 1;
    }
    if (cm_values_are_stored(values) && values->type == CM_PIXEL_U8 &&
        stride == (ptrdiff_t)values->channels)
    {
        load_bytes(from, numbers, to);
        return 1;
    }
    return 0;
}

void cm_values_load(const cm_values *values, const void *from, ptrdiff_t stride, size_t n,
                    float *to)
{
    const unsigned char *pixel = from;
    if (load_dense(values, from, stride, n, to))
    {
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        float *out = to + i * values->working;
        for (uint32_t c = 0; c < values->channels; c++)
        {
            out[c] = read_channel(values->type, pixel, c);
        }
        const int good = values->not_finite == CM_NOT_FINITE_SPREAD || clean(values, out);
        if (is_coded_vector(values))
        {
            decode_vector(values, out);
        }
        load_meaning(values, out);
        if (values->working > values->channels)
        {
            out[values->channels] = good ? 1.0f : 0.0f;
        }
        pixel += stride;
    }
}

/* ---- back ---- */

static void store_meaning(const cm_values *values, float *pixel)
{
    const uint32_t alpha = values->alpha;
    if (values->working > values->channels)
    {
        const float weight = pixel[values->channels];
        for (uint32_t c = 0; c < values->channels; c++)
        {
            pixel[c] = weight > 1e-6f ? pixel[c] / weight : (float)NAN;
        }
    }
    if (values->vector != 0)
    {
        float *v = pixel + values->vector - 1;
        const float old[3] = {v[0], v[1], v[2]};
        for (int i = 0; i < 3; i++)
        {
            v[i] = values->turn[i][0] * old[0] + values->turn[i][1] * old[1] +
                   values->turn[i][2] * old[2];
        }
    }
    const float opacity = alpha != 0 ? pixel[alpha - 1] : 1.0f;
    for (uint32_t c = 0; c < values->channels; c++)
    {
        if (c + 1 == alpha)
        {
            continue;
        }
        if (alpha != 0 && (!values->alpha_multiplied || values->transfer != CM_TRANSFER_STORED))
        {
            pixel[c] = opacity > 0.0f ? pixel[c] / opacity : 0.0f;
        }
        if (values->transfer != CM_TRANSFER_STORED)
        {
            pixel[c] = (is_vector(values, c) ? pixel[c] : stored_of(values, pixel[c])) *
                       (alpha != 0 && values->alpha_multiplied ? opacity : 1.0f);
        }
    }
}

/* Between -1/2 and 1/2, without a pattern that the eye sees: a hash of the place (M. Wellons's lowbias32). */
static float noise(uint32_t column, uint32_t row, uint32_t channel)
{
    uint32_t x = column * 0x9e3779b1u + row * 0x85ebca77u + channel * 0xc2b2ae3du;
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return (float)(x >> 8) * 0x1p-24f - 0.5f;
}

void cm_values_store(const cm_values *values, float *from, size_t n, uint32_t column, uint32_t row,
                     void *to, ptrdiff_t stride)
{
    unsigned char *pixel = to;
    if (store_dense(values, from, n, to, stride))
    {
        return;
    }
    for (size_t i = 0; i < n; i++)
    {
        float *in = from + i * values->working;
        store_meaning(values, in);
        if (is_coded_vector(values))
        {
            encode_vector(values, in);
        }
        for (uint32_t c = 0; c < values->channels; c++)
        {
            const float offset = values->dither ? noise(column + (uint32_t)i, row, c) : 0.0f;
            write_channel(values->type, in[c], offset, pixel, c);
        }
        pixel += stride;
    }
}
