/* SPDX-License-Identifier: MIT
 *
 * Reading: the specifications of Netpbm, "pgm", "ppm" and "pam" (numbers in ASCII with blanks and comments between, one
 * blank behind the last; samples above 255 in two bytes, the high one first), and of PFM by Debevec (the scale's sign is the
 * order of bytes, negative for little endian; rows from the lowest).
 */
#include "pnm_file.h"

#include "file_words.h"
#include "header_lines.h"
#include "pnm_words.h"

#include <stdlib.h>
#include <string.h>

/* ---- samples ---- */

/* Whole numbers to 0 to 255 or 0 to 65535. */
static cm_status scale_row(const cm_pnm_picture *picture, void *row, size_t count, char *message)
{
    const uint32_t maximum = picture->maximum;
    const uint32_t full = picture->type == CM_PIXEL_U8 ? UINT8_MAX : UINT16_MAX;
    if (maximum == 0 || maximum == full)
    {
        return CM_OK;
    }
    uint8_t *const bytes = row;
    uint16_t *const words = row;
    for (size_t i = 0; i < count; i++)
    {
        const uint32_t value = picture->type == CM_PIXEL_U8 ? bytes[i] : words[i];
        if (value > maximum)
        {
            return cm_file_fail(message, "has a sample of %lu, above the largest value, %lu",
                                (unsigned long)value, (unsigned long)maximum);
        }
        const uint32_t scaled = (uint32_t)(((uint64_t)value * full + maximum / 2) / maximum);
        if (picture->type == CM_PIXEL_U8)
        {
            bytes[i] = (uint8_t)scaled;
        }
        else
        {
            words[i] = (uint16_t)scaled;
        }
    }
    return CM_OK;
}

static bool take_row(cm_pnm_reader *reader, unsigned char *row, size_t size)
{
    const size_t held = (size_t)reader->held_count;
    if (held > 0)
    {
        *row = reader->held;
        reader->held_count = 0;
    }
    return cm_file_take(reader->stream, row + held, size - held);
}

/* ---- reading ---- */

static bool is_reader(const cm_pnm_reader *reader)
{
    return reader != NULL && reader->size == sizeof *reader && reader->stream != NULL &&
           reader->stream->read != NULL;
}

/* A line that is not one of ours, or does not fit, leaves its room to those behind it. */
static void keep_byte(cm_pnm_reader *reader, char byte)
{
    char *const line = reader->header + reader->header_size;
    if (reader->header_size + reader->header_line == sizeof reader->header)
    {
        reader->header_full = 1;
    }
    else
    {
        line[reader->header_line++] = byte;
    }
    if (byte == '\n')
    {
        const char *at = line;
        cm_header_line found;
        const bool kept =
            !reader->header_full && cm_header_lines_next(&at, line + reader->header_line, &found);
        reader->header_size += kept ? reader->header_line : 0;
        reader->header_line = 0;
        reader->header_full = 0;
    }
}

/* Reads for a header, and keeps what it says of us. */
static size_t take_header(void *context, void *bytes, size_t count)
{
    cm_pnm_reader *const reader = context;
    const size_t taken = reader->stream->read(reader->stream->context, bytes, count);
    for (size_t i = 0; i < taken; i++)
    {
        keep_byte(reader, ((const char *)bytes)[i]);
    }
    return taken;
}

static cm_status next_picture(cm_pnm_reader *reader, cm_pnm_picture *found, bool *some,
                              char *message)
{
    const bool raw = found->kind == CM_PNM_RAW;
    if (raw)
    {
        const cm_status status = cm_pnm_check(found, message);
        if (status != CM_OK)
        {
            return status;
        }
        found->maximum = 0;
        found->scale = 1.0F;
        found->bottom_up = 0;
    }
    *some = cm_file_take(reader->stream, &reader->held, 1);
    if (!*some)
    {
        return CM_OK;
    }
    reader->held_count = raw ? 1 : 0;
    reader->header_size = reader->header_line = 0;
    reader->header_full = 0;
    const cm_image_stream noted = {reader, take_header, NULL, NULL, NULL};
    return raw ? CM_OK : cm_pnm_read_header(&noted, (char)reader->held, found, message);
}

cm_status cm_pnm_next(cm_pnm_reader *reader, cm_pnm_picture *picture, bool *more, char *message)
{
    if (!is_reader(reader) || picture == NULL || picture->size != sizeof *picture || more == NULL ||
        reader->rows_left > 0)
    {
        cm_file_fail(message, "cannot be read: no stream, or rows of a picture are left");
        return CM_ERROR_ARGUMENT;
    }
    cm_pnm_picture found = {.size = sizeof found};
    if (picture->kind == CM_PNM_RAW)
    {
        found = *picture;
    }
    bool some = false;
    const cm_status status = next_picture(reader, &found, &some, message);
    if (status != CM_OK)
    {
        return status;
    }
    *more = some;
    if (some)
    {
        reader->picture = found;
        reader->rows_left = found.height;
        *picture = found;
    }
    return CM_OK;
}

cm_status cm_pnm_read(cm_pnm_reader *reader, uint32_t rows, void *pixels, ptrdiff_t row_stride,
                      char *message)
{
    if (!is_reader(reader) || pixels == NULL || rows > reader->rows_left)
    {
        cm_file_fail(message, "cannot be read: there are no such rows");
        return CM_ERROR_ARGUMENT;
    }
    const cm_pnm_picture *const picture = &reader->picture;
    const size_t sample = cm_file_sample_size(picture->type);
    const size_t count = (size_t)picture->width * picture->channels;
    const ptrdiff_t down = row_stride != 0 ? row_stride : (ptrdiff_t)(count * sample);
    const bool own_order = picture->kind == CM_PNM_PFM || picture->kind == CM_PNM_RAW;
    for (uint32_t i = 0; i < rows; i++)
    {
        unsigned char *const row = (unsigned char *)pixels + down * (ptrdiff_t)i;
        if (!take_row(reader, row, count * sample))
        {
            return cm_file_fail(message, "ends too early: %lu of %lu rows are missing",
                                (unsigned long)reader->rows_left, (unsigned long)picture->height);
        }
        cm_file_order(row, count, sample, own_order && picture->little_endian);
        const cm_status status = scale_row(picture, row, count, message);
        if (status != CM_OK)
        {
            return status;
        }
        reader->rows_left--;
    }
    return CM_OK;
}

/* ---- writing ---- */

cm_status cm_pnm_write_rows(const cm_image_stream *stream, const cm_pnm_picture *picture,
                            const cm_image *rows, char *message)
{
    if (stream == NULL || stream->write == NULL || rows == NULL || rows->data == NULL)
    {
        cm_file_fail(message, "cannot be written: no stream or no rows");
        return CM_ERROR_ARGUMENT;
    }
    const cm_status status = cm_pnm_check(picture, message);
    if (status != CM_OK)
    {
        return status;
    }
    const size_t sample = cm_file_sample_size(picture->type);
    const size_t pixel = sample * picture->channels;
    const size_t row_size = pixel * picture->width;
    const ptrdiff_t step = rows->pixel_stride != 0 ? rows->pixel_stride : (ptrdiff_t)pixel;
    const ptrdiff_t down =
        rows->row_stride != 0 ? rows->row_stride : step * (ptrdiff_t)picture->width;
    const bool own_order = picture->kind == CM_PNM_PFM || picture->kind == CM_PNM_RAW;
    unsigned char *const row = malloc(row_size);
    if (row == NULL)
    {
        cm_file_fail(message, "cannot be written: no memory");
        return CM_ERROR_MEMORY;
    }
    bool good = true;
    for (uint32_t i = 0; i < rows->height && good; i++)
    {
        const unsigned char *const from = (const unsigned char *)rows->data + down * (ptrdiff_t)i;
        if (step == (ptrdiff_t)pixel)
        {
            memcpy(row, from, row_size);
        }
        for (uint32_t j = 0; j < picture->width && step != (ptrdiff_t)pixel; j++)
        {
            memcpy(row + pixel * j, from + step * (ptrdiff_t)j, pixel);
        }
        cm_file_order(row, row_size / sample, sample, own_order && picture->little_endian);
        good = cm_file_put(stream, row, row_size);
    }
    free(row);
    return good ? CM_OK : cm_file_fail(message, "cannot be written: no more bytes are taken");
}

cm_status cm_pnm_write(const cm_image_stream *stream, const cm_pnm_picture *picture,
                       const cm_image *image, char *message)
{
    if (picture == NULL || picture->size != sizeof *picture || image == NULL ||
        image->size != sizeof *image || image->data == NULL)
    {
        cm_file_fail(message, "cannot be written: no picture");
        return CM_ERROR_ARGUMENT;
    }
    cm_pnm_picture whole = *picture;
    whole.width = image->width;
    whole.height = image->height;
    whole.channels = image->channels;
    whole.type = image->type;
    const cm_status status = cm_pnm_write_header(stream, &whole, message);
    if (status != CM_OK)
    {
        return status;
    }
    cm_image rows = *image;
    if (picture->kind == CM_PNM_PFM)
    {
        const size_t pixel = cm_file_sample_size(image->type) * image->channels;
        const ptrdiff_t step = image->pixel_stride != 0 ? image->pixel_stride : (ptrdiff_t)pixel;
        const ptrdiff_t down =
            image->row_stride != 0 ? image->row_stride : step * (ptrdiff_t)image->width;
        rows.data = (unsigned char *)image->data + down * (ptrdiff_t)(image->height - 1);
        rows.row_stride = -down;
    }
    return cm_pnm_write_rows(stream, &whole, &rows, message);
}
