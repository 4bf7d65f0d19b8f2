/* SPDX-License-Identifier: MIT
 *
 * IVOA Recommendation "HiPS - Hierarchical Progressive Survey", version 1.0 (Fernique et al. 2017): section 4.1 has the
 * tiles, 4.2 their names, 4.3.2 the preview, 4.4 the properties.
 *
 * With x and y of a pixel as HEALPix has them (x towards north-east, y towards north-west from the south corner), FITS has
 * its columns along y and its rows against x, and PNG, whose rows are from the top, along x.
 */
#include "hips.h"

#include "fits_cards.h"
#include "file_words.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Pictures with twelve planes side by side are not wider than 2^30. */
#define PLANE_ORDER_MOST 26

static bool is_tile(uint32_t order, uint64_t number)
{
    return order <= CM_HIPS_ORDER_MOST && number < (uint64_t)12 << 2 * order;
}

/* Every other bit. */
static uint32_t even_bits(uint64_t bits)
{
    uint32_t value = 0;
    for (unsigned i = 0; i < 32; i++)
    {
        value |= (uint32_t)(bits >> 2 * i & 1) << i;
    }
    return value;
}

cm_status cm_hips_place(uint32_t order, uint64_t number, uint32_t width, cm_hips_window *window)
{
    if (window == NULL || width == 0 || (width & (width - 1)) != 0)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!is_tile(order, number))
    {
        return CM_ERROR_PIXEL;
    }
    if (((uint64_t)width << order) > (uint64_t)1 << PLANE_ORDER_MOST)
    {
        return CM_ERROR_RANGE;
    }
    const uint64_t inside = number & (((uint64_t)1 << 2 * order) - 1);
    const uint32_t x = even_bits(inside);
    const uint32_t y = even_bits(inside >> 1);
    const uint32_t side = (uint32_t)1 << order;
    window->plane = (uint32_t)(number >> 2 * order);
    window->column = x * width;
    window->row = (side - 1 - y) * width;
    window->width = width;
    window->planes = side * width;
    return CM_OK;
}

/* A plane's columns are x, and its rows y from below: the tile is a plane turned by a quarter. */
cm_status cm_hips_tile(const cm_image *window, cm_image *tile)
{
    if (window == NULL || tile == NULL || window->data == NULL || window->size != sizeof *window ||
        window->width != window->height || window->width == 0)
    {
        return CM_ERROR_ARGUMENT;
    }
    const size_t pixel = cm_file_sample_size(window->type) * window->channels;
    const ptrdiff_t right = window->pixel_stride != 0 ? window->pixel_stride : (ptrdiff_t)pixel;
    const ptrdiff_t down =
        window->row_stride != 0 ? window->row_stride : right * (ptrdiff_t)window->width;
    cm_image turned = *window;
    turned.data = (unsigned char *)window->data + down * (ptrdiff_t)(window->height - 1);
    turned.pixel_stride = -down;
    turned.row_stride = right;
    *tile = turned;
    return CM_OK;
}

/* ---- names ---- */

static bool is_format(const char *format)
{
    return format != NULL && (strcmp(format, "png") == 0 || strcmp(format, "jpg") == 0 ||
                              strcmp(format, "fits") == 0);
}

cm_status cm_hips_tile_path(uint32_t order, uint64_t number, const char *format,
                            char path[CM_HIPS_PATH])
{
    if (path == NULL || !is_format(format))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!is_tile(order, number))
    {
        return CM_ERROR_PIXEL;
    }
    snprintf(path, CM_HIPS_PATH, "Norder%" PRIu32 "/Dir%" PRIu64 "/Npix%" PRIu64 ".%s", order,
             number / 10000 * 10000, number, format);
    return CM_OK;
}

cm_status cm_hips_preview_path(uint32_t order, const char *format, char path[CM_HIPS_PATH])
{
    if (path == NULL || !is_format(format))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (order > CM_HIPS_ORDER_MOST)
    {
        return CM_ERROR_RANGE;
    }
    snprintf(path, CM_HIPS_PATH, "Norder%" PRIu32 "/Allsky.%s", order, format);
    return CM_OK;
}

cm_status cm_hips_preview(uint32_t order, uint32_t *columns, uint32_t *rows)
{
    if (columns == NULL || rows == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (order > 13)
    {
        return CM_ERROR_RANGE;
    }
    const uint32_t count = (uint32_t)12 << 2 * order;
    const uint32_t in_row = (uint32_t)sqrt((double)count);
    *columns = in_row;
    *rows = (count + in_row - 1) / in_row;
    return CM_OK;
}

/* ---- properties ---- */

typedef struct growing_text
{
    char *at;
    size_t room;
    size_t length;
    bool bad;
} growing_text;

static void add_line(growing_text *text, const char *key, const char *value)
{
    if (value == NULL)
    {
        return;
    }
    for (const char *c = value; *c != '\0'; c++)
    {
        text->bad = text->bad || (unsigned char)*c < 0x20 || *c == 0x7f;
    }
    const size_t left = text->room > text->length ? text->room - text->length : 0;
    char *const at = left > 0 ? text->at + text->length : NULL;
    text->length += (size_t)snprintf(at, left, "%-20s = %s\n", key, value);
}

static void add_number(growing_text *text, const char *key, uint32_t number)
{
    char value[16];
    snprintf(value, sizeof value, "%" PRIu32, number);
    add_line(text, key, value);
}

static void add_properties(const cm_hips_properties *p, growing_text *text)
{
    add_line(text, "creator_did", p->creator_did);
    add_line(text, "obs_title", p->title);
    add_line(text, "obs_copyright", p->copyright);
    add_line(text, "dataproduct_type", "image");
    add_line(text, "hips_version", "1.4");
    add_line(text, "hips_builder", p->builder);
    add_line(text, "hips_release_date", p->release);
    add_line(text, "hips_status", p->status != NULL ? p->status : "public master clonableOnce");
    add_line(text, "hips_frame", p->frame);
    add_number(text, "hips_order", p->order);
    add_number(text, "hips_order_min", p->order_least);
    add_number(text, "hips_tile_width", p->tile_width);
    add_line(text, "hips_tile_format", p->tile_format);
}

cm_status cm_hips_write_properties(const cm_hips_properties *properties, size_t room, char *text,
                                   size_t *length)
{
    const cm_hips_properties *const p = properties;
    if (p == NULL || p->size != sizeof *p || length == NULL || (text == NULL && room > 0) ||
        p->creator_did == NULL || p->title == NULL || p->frame == NULL || p->tile_format == NULL ||
        p->release == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (p->order > CM_HIPS_ORDER_MOST || p->order_least > p->order || p->tile_width == 0 ||
        (p->tile_width & (p->tile_width - 1)) != 0)
    {
        return CM_ERROR_RANGE;
    }
    growing_text counted = {NULL, 0, 0, false};
    add_properties(p, &counted);
    if (counted.bad)
    {
        return CM_ERROR_ARGUMENT;
    }
    *length = counted.length;
    if (room <= counted.length)
    {
        return CM_ERROR_SPACE;
    }
    growing_text written = {text, room, 0, false};
    add_properties(p, &written);
    return CM_OK;
}

/* ---- FITS ---- */

static bool write_head(const cm_image_stream *stream, uint32_t order, uint64_t number,
                       const cm_image *tile)
{
    cm_fits_head head = {.stream = stream, .good = true};
    const bool words = tile->type == CM_PIXEL_U16;
    cm_fits_card(&head, "SIMPLE", "T");
    cm_fits_card_number(&head, "BITPIX", tile->type == CM_PIXEL_FLOAT ? -32 : words ? 16 : 8);
    cm_fits_card_number(&head, "NAXIS", 2);
    cm_fits_card_number(&head, "NAXIS1", tile->width);
    cm_fits_card_number(&head, "NAXIS2", tile->height);
    if (words)
    {
        cm_fits_card_number(&head, "BZERO", 32768);
        cm_fits_card_number(&head, "BSCALE", 1);
    }
    cm_fits_card_number(&head, "ORDER", order);
    cm_fits_card_number(&head, "NPIX", (int64_t)number);
    return cm_fits_end(&head);
}

/* Numbers of two bytes are signed in FITS, and BZERO moves them. */
static void order_row(const cm_image *tile, unsigned char *row)
{
    const size_t sample = cm_file_sample_size(tile->type);
    cm_file_order(row, tile->width, sample, false);
    for (size_t i = 0; i < tile->width && tile->type == CM_PIXEL_U16; i++)
    {
        row[2 * i] ^= 0x80;
    }
}

static bool write_rows(const cm_image_stream *stream, const cm_image *tile, unsigned char *row)
{
    const size_t sample = cm_file_sample_size(tile->type);
    const ptrdiff_t right = tile->pixel_stride != 0 ? tile->pixel_stride : (ptrdiff_t)sample;
    const ptrdiff_t down =
        tile->row_stride != 0 ? tile->row_stride : right * (ptrdiff_t)tile->width;
    for (uint32_t i = tile->height; i-- > 0;)
    {
        const unsigned char *const from = (const unsigned char *)tile->data + down * (ptrdiff_t)i;
        for (uint32_t j = 0; j < tile->width; j++)
        {
            memcpy(row + sample * j, from + right * (ptrdiff_t)j, sample);
        }
        order_row(tile, row);
        if (!cm_file_put(stream, row, sample * tile->width))
        {
            return false;
        }
    }
    return cm_fits_fill(stream, (uint64_t)tile->width * tile->height * sample);
}

cm_status cm_hips_write_fits(const cm_image_stream *stream, uint32_t order, uint64_t number,
                             const cm_image *tile, char *message)
{
    if (stream == NULL || stream->write == NULL || tile == NULL || tile->data == NULL ||
        tile->size != sizeof *tile || tile->width != tile->height || tile->width == 0 ||
        tile->channels != 1 || tile->type == CM_PIXEL_HALF || cm_file_sample_size(tile->type) == 0)
    {
        cm_file_fail(message, "cannot be written: a tile in FITS is a square of one channel of 8 "
                              "or 16 bits or floats");
        return CM_ERROR_ARGUMENT;
    }
    if (!is_tile(order, number))
    {
        cm_file_fail(message, "cannot be written: order %lu has no tile of that number",
                     (unsigned long)order);
        return CM_ERROR_PIXEL;
    }
    unsigned char *const row = malloc((size_t)tile->width * cm_file_sample_size(tile->type));
    if (row == NULL)
    {
        cm_file_fail(message, "cannot be written: no memory");
        return CM_ERROR_MEMORY;
    }
    const bool good = write_head(stream, order, number, tile) && write_rows(stream, tile, row);
    free(row);
    return good ? CM_OK : cm_file_fail(message, "cannot be written: no more bytes are taken");
}
