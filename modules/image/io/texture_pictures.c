/* SPDX-License-Identifier: MIT */
#include "texture_format.h"

#include <stdlib.h>

#include "modules/image/half.h"

const cm_texture_numbers cm_texture_formats[CM_TEXTURE_FORMATS] = {
    [CM_TEXTURE_RGBA8] = {CM_PIXEL_U8, 28, 37, 4},
    [CM_TEXTURE_RGBA8_SRGB] = {CM_PIXEL_U8, 29, 43, 4},
    [CM_TEXTURE_RGBA16] = {CM_PIXEL_U16, 11, 91, 8},
    [CM_TEXTURE_RGBA16F] = {CM_PIXEL_HALF, 10, 97, 8},
    [CM_TEXTURE_RGBA32F] = {CM_PIXEL_FLOAT, 2, 109, 16},
};

static bool is_format(cm_texture_format format)
{
    return (unsigned)format < CM_TEXTURE_FORMATS;
}

cm_pixel_type cm_texture_type(cm_texture_format format)
{
    return is_format(format) ? cm_texture_formats[format].type : CM_PIXEL_U8;
}

uint32_t cm_texture_levels(uint32_t width, uint32_t height)
{
    uint32_t levels = 1;
    while ((width > 1 || height > 1) && (width == 1 || width % 2 == 0) &&
           (height == 1 || height % 2 == 0) && levels < CM_TEXTURE_LEVELS_MOST)
    {
        width = width > 1 ? width / 2 : 1;
        height = height > 1 ? height / 2 : 1;
        levels++;
    }
    return levels;
}

cm_status cm_texture_check(const cm_texture *texture, char *message)
{
    const uint32_t width = texture->width;
    const uint32_t height = texture->height;
    if (width < 1 || height < 1 || width > CM_TEXTURE_SIZE_MOST || height > CM_TEXTURE_SIZE_MOST)
    {
        cm_file_fail(message, "cannot be a texture of %lu x %lu pixels: 1 to %d each can",
                     (unsigned long)width, (unsigned long)height, CM_TEXTURE_SIZE_MOST);
        return CM_ERROR_ARGUMENT;
    }
    if ((texture->faces != 1 && texture->faces != 6) || (texture->faces == 6 && width != height))
    {
        cm_file_fail(message,
                     "cannot be a texture of %lu faces of %lu x %lu pixels: one picture, "
                     "or six squares, can",
                     (unsigned long)texture->faces, (unsigned long)width, (unsigned long)height);
        return CM_ERROR_ARGUMENT;
    }
    const uint32_t longer = width > height ? width : height;
    if (texture->levels < 1 || texture->levels > CM_TEXTURE_LEVELS_MOST ||
        longer >> (texture->levels - 1) == 0)
    {
        cm_file_fail(message, "cannot have %lu levels of %lu x %lu pixels",
                     (unsigned long)texture->levels, (unsigned long)width, (unsigned long)height);
        return CM_ERROR_ARGUMENT;
    }
    return CM_OK;
}

static cm_status check_pictures(const cm_texture *texture, const cm_image *const *levels,
                                char *message)
{
    for (uint32_t level = 0; level < texture->levels; level++)
    {
        const uint32_t width = cm_texture_extent(texture->width, level);
        const uint32_t height = cm_texture_extent(texture->height, level);
        for (uint32_t face = 0; face < texture->faces; face++)
        {
            const cm_image *const image = levels[level] != NULL ? &levels[level][face] : NULL;
            if (image == NULL || image->data == NULL || image->size != sizeof *image)
            {
                cm_file_fail(message, "cannot be written: level %lu has no pictures",
                             (unsigned long)level);
                return CM_ERROR_ARGUMENT;
            }
            if (image->width != width || image->height != height ||
                image->type != cm_texture_type(texture->format) || image->channels < 1 ||
                image->channels > 4)
            {
                cm_file_fail(message,
                             "cannot be written: level %lu is to have %lu x %lu pixels of the "
                             "format's type and 1 to 4 channels, and has %lu x %lu of %lu",
                             (unsigned long)level, (unsigned long)width, (unsigned long)height,
                             (unsigned long)image->width, (unsigned long)image->height,
                             (unsigned long)image->channels);
                return CM_ERROR_RANGE;
            }
        }
    }
    return CM_OK;
}

/* ---- writing ---- */

static void put_one(cm_pixel_type type, unsigned char *to)
{
    const uint16_t half = cm_half_of_float(1.0F);
    const uint16_t whole = UINT16_MAX;
    const float number = 1.0F;
    switch (type)
    {
    case CM_PIXEL_U16:
        memcpy(to, &whole, sizeof whole);
        break;
    case CM_PIXEL_HALF:
        memcpy(to, &half, sizeof half);
        break;
    case CM_PIXEL_FLOAT:
        memcpy(to, &number, sizeof number);
        break;
    default:
        *to = UINT8_MAX;
    }
}

/* Four channels of each pixel. */
static void spread_row(const cm_image *image, const unsigned char *from, ptrdiff_t step,
                       unsigned char *to)
{
    const size_t size = cm_file_sample_size(image->type);
    const size_t colours = image->channels >= 3 ? 3 : 1;
    for (uint32_t i = 0; i < image->width; i++, to += 4 * size)
    {
        const unsigned char *const pixel = from + step * (ptrdiff_t)i;
        for (size_t channel = 0; channel < 3; channel++)
        {
            memcpy(to + channel * size, pixel + (colours == 3 ? channel : 0) * size, size);
        }
        if (image->channels == colours)
        {
            put_one(image->type, to + 3 * size);
        }
        else
        {
            memcpy(to + 3 * size, pixel + colours * size, size);
        }
    }
}

static bool write_picture(const cm_image_stream *stream, const cm_image *image, unsigned char *row)
{
    const size_t size = cm_file_sample_size(image->type);
    const ptrdiff_t step =
        image->pixel_stride != 0 ? image->pixel_stride : (ptrdiff_t)(size * image->channels);
    const ptrdiff_t down =
        image->row_stride != 0 ? image->row_stride : step * (ptrdiff_t)image->width;
    for (uint32_t i = 0; i < image->height; i++)
    {
        spread_row(image, (const unsigned char *)image->data + down * (ptrdiff_t)i, step, row);
        cm_file_order(row, 4 * (size_t)image->width, size, true);
        if (!cm_file_put(stream, row, 4 * size * image->width))
        {
            return false;
        }
    }
    return true;
}

/* DDS has faces with their levels, KTX has levels, the smallest first, with their faces. */
static bool write_pictures(const cm_image_stream *stream, const cm_texture *texture,
                           const cm_image *const *levels, unsigned char *row)
{
    const bool dds = texture->container == CM_TEXTURE_DDS;
    const uint32_t count = texture->faces * texture->levels;
    for (uint32_t i = 0; i < count; i++)
    {
        const uint32_t level = dds ? i % texture->levels : texture->levels - 1 - i / texture->faces;
        const uint32_t face = dds ? i / texture->levels : i % texture->faces;
        if (!write_picture(stream, &levels[level][face], row))
        {
            return false;
        }
    }
    return true;
}

cm_status cm_texture_write(const cm_image_stream *stream, const cm_texture *texture,
                           const cm_image *const *levels, char *message)
{
    if (stream == NULL || stream->write == NULL || texture == NULL || levels == NULL ||
        texture->size != sizeof *texture || !is_format(texture->format) ||
        (unsigned)texture->container > CM_TEXTURE_KTX2)
    {
        cm_file_fail(message, "cannot be written: no such kind of file or of texels");
        return CM_ERROR_ARGUMENT;
    }
    cm_status status = cm_texture_check(texture, message);
    status = status == CM_OK ? check_pictures(texture, levels, message) : status;
    unsigned char *const row =
        status == CM_OK
            ? malloc((size_t)texture->width * cm_texture_formats[texture->format].texel_size)
            : NULL;
    if (status == CM_OK && row == NULL)
    {
        cm_file_fail(message, "cannot be written: no memory");
        status = CM_ERROR_MEMORY;
    }
    if (status == CM_OK && texture->container == CM_TEXTURE_DDS)
    {
        status = cm_dds_write_head(stream, texture, message);
    }
    else if (status == CM_OK)
    {
        uint64_t offsets[CM_TEXTURE_LEVELS_MOST];
        uint64_t end = 0;
        status = cm_ktx_write_head(stream, texture, offsets, &end, message);
        if (status == CM_OK && !cm_file_pad(stream, (size_t)(offsets[texture->levels - 1] - end)))
        {
            status = cm_file_fail(message, "cannot be written: no more bytes are taken");
        }
    }
    if (status == CM_OK && !write_pictures(stream, texture, levels, row))
    {
        status = cm_file_fail(message, "cannot be written: no more bytes are taken");
    }
    free(row);
    return status;
}

/* ---- reading ---- */

cm_status cm_texture_open(const cm_image_stream *stream, cm_texture *texture, char *message)
{
    unsigned char begin[4];
    if (stream == NULL || stream->read == NULL || stream->seek == NULL || stream->size == NULL ||
        texture == NULL)
    {
        cm_file_fail(message, "cannot be read: no stream");
        return CM_ERROR_ARGUMENT;
    }
    cm_texture found = {.size = sizeof found};
    stream->seek(stream->context, 0);
    if (!cm_file_take(stream, begin, sizeof begin))
    {
        return cm_file_fail(message, "is too short to be a texture");
    }
    const bool dds = memcmp(begin, "DDS ", 4) == 0;
    if (!dds && memcmp(begin, "\xabKTX", 4) != 0)
    {
        return cm_file_fail(message, "is neither a DDS nor a KTX file");
    }
    found.container = dds ? CM_TEXTURE_DDS : CM_TEXTURE_KTX2;
    const cm_status status =
        dds ? cm_dds_open(stream, &found, message) : cm_ktx_open(stream, &found, message);
    if (status == CM_OK)
    {
        *texture = found;
    }
    return status;
}

cm_status cm_texture_read(const cm_image_stream *stream, const cm_texture *texture, uint32_t level,
                          uint32_t face, void *pixels, ptrdiff_t row_stride, char *message)
{
    if (stream == NULL || texture == NULL || texture->size != sizeof *texture || pixels == NULL ||
        level >= texture->levels || face >= texture->faces || !is_format(texture->format))
    {
        cm_file_fail(message, "has no such level or face");
        return CM_ERROR_ARGUMENT;
    }
    const size_t sample = cm_file_sample_size(cm_texture_type(texture->format));
    const size_t width = cm_texture_extent(texture->width, level);
    const uint32_t height = cm_texture_extent(texture->height, level);
    const size_t row_size = 4 * sample * width;
    const uint64_t step = texture->container == CM_TEXTURE_DDS
                              ? texture->face_step
                              : cm_texture_face_size(texture, level);
    const ptrdiff_t down = row_stride != 0 ? row_stride : (ptrdiff_t)row_size;
    stream->seek(stream->context, (int64_t)(texture->offsets[level] + step * face));
    for (uint32_t i = 0; i < height; i++)
    {
        unsigned char *const row = (unsigned char *)pixels + down * (ptrdiff_t)i;
        if (!cm_file_take(stream, row, row_size))
        {
            return cm_file_fail(message, "ends too early, in level %lu", (unsigned long)level);
        }
        cm_file_order(row, 4 * width, sample, true);
    }
    return CM_OK;
}
