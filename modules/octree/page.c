/* SPDX-License-Identifier: MIT
 *
 * A region as bytes, the least first: its place (3 u32), then of each block its form and detail (u8: detail << 4 | form), 1 if it
 * has colors, 2 if all are one (u8), alpha or misses (u8), the step of its last change (u32), and the bytes of the block itself: palette and bits,
 * or bytes, and a word of color for each occupied cell, or of all.
 */
#include "modules/memory/checked_size.h"
#include "page.h"

#include <stdlib.h>
#include <string.h>

#include "interleave.h"

#define PAGE_KIND 0x4f435252u /* "RRCO" */
#define PAGE_VERSION 1u

#define HEAD_BYTES 12u
#define BLOCK_HEAD_BYTES 7u

static void key_of(const uint32_t place[3], unsigned char key[9])
{
    const uint32_t at[3] = {place[0] >> CM_REGION_LEVEL, place[1] >> CM_REGION_LEVEL,
                            place[2] >> CM_REGION_LEVEL};
    const uint64_t number = cm_interleave(at);
    key[0] = 'r';
    for (int i = 0; i < 8; i++)
    {
        key[1 + i] = (unsigned char)(number >> (56 - 8 * i));
    }
}

static void put_word(unsigned char *to, uint32_t word)
{
    for (int i = 0; i < 4; i++)
    {
        to[i] = (unsigned char)(word >> 8 * i);
    }
}

static uint32_t get_word(const unsigned char *from)
{
    return (uint32_t)from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 |
           (uint32_t)from[3] << 24;
}

/* Bytes of a packed block: of its cells and their palette. */
static size_t packed_bytes(unsigned form, unsigned detail)
{
    const size_t cells = cm_cell_count(detail);
    return form == CM_BLOCK_EVEN    ? 0
           : form == CM_BLOCK_BYTES ? cells
                                    : ((size_t)1 << form) + (cells * form + 7) / 8;
}

static size_t occupied_cells(const unsigned char *alpha, unsigned form, size_t cells)
{
    size_t count = 0;
    for (size_t cell = 0; cell < cells; cell++)
    {
        const unsigned char *bits = alpha + ((size_t)1 << form);
        const unsigned value =
            form == CM_BLOCK_BYTES
                ? alpha[cell]
                : alpha[bits[cell * form / 8] >> cell * form % 8 & ((1u << form) - 1u)];
        count += value > CM_UNKNOWN;
    }
    return count;
}

/* ---- writing ---- */

static size_t block_size(const cm_region *region, unsigned block)
{
    const unsigned form = region->form[block], detail = region->detail[block];
    size_t bytes = BLOCK_HEAD_BYTES + packed_bytes(form, detail);
    if (region->color != NULL && region->color[block] != NULL)
    {
        bytes += 4 * (cm_has_one_color(region, block)
                          ? 1
                          : occupied_cells(region->alpha[block], form, cm_cell_count(detail)));
    }
    return bytes;
}

static unsigned char *write_block(const cm_region *region, unsigned block, unsigned char *to)
{
    const unsigned form = region->form[block], detail = region->detail[block];
    const int has_colors = region->color != NULL && region->color[block] != NULL;
    to[0] = (unsigned char)(detail << 4 | form);
    to[1] = (unsigned char)(!has_colors ? 0 : cm_has_one_color(region, block) ? 2 : 1);
    to[2] = region->value[block];
    put_word(to + 3, region->changed[block]);
    to += BLOCK_HEAD_BYTES;
    const size_t bytes = packed_bytes(form, detail);
    if (bytes > 0)
    {
        memcpy(to, region->alpha[block], bytes);
        to += bytes;
    }
    const size_t colors = has_colors && cm_has_one_color(region, block) ? 1
                          : has_colors
                              ? occupied_cells(region->alpha[block], form, cm_cell_count(detail))
                              : 0;
    for (size_t i = 0; i < colors; i++, to += 4)
    {
        put_word(to, region->color[block][i]);
    }
    return to;
}

cm_status cm_page_put(const cm_octree *octree, cm_store *store, cm_region *region)
{
    size_t bytes = HEAD_BYTES;
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        if (!cm_block_pack(region, block, &octree->rule))
        {
            return CM_ERROR_MEMORY;
        }
        bytes += block_size(region, block);
    }
    unsigned char *data = malloc(bytes);
    if (data == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (int axis = 0; axis < 3; axis++)
    {
        put_word(data + 4 * axis, region->place[axis]);
    }
    unsigned char *to = data + HEAD_BYTES;
    for (unsigned block = 0; block < CM_REGION_BLOCKS; block++)
    {
        to = write_block(region, block, to);
    }
    unsigned char bytes_of_key[9];
    key_of(region->place, bytes_of_key);
    const cm_store_key key = {bytes_of_key, sizeof bytes_of_key};
    const cm_blob blob = {sizeof blob, PAGE_KIND, PAGE_VERSION, data, bytes};
    const cm_status status = cm_store_put(store, &key, &blob);
    free(data);
    region->has_page |= status == CM_OK && store == octree->options.pages;
    return status;
}

cm_status cm_page_remove(cm_store *store, const uint32_t place[3])
{
    unsigned char bytes_of_key[9];
    key_of(place, bytes_of_key);
    const cm_store_key key = {bytes_of_key, sizeof bytes_of_key};
    return cm_store_remove(store, &key);
}

/* ---- reading: nothing is believed ---- */

typedef struct page_reader
{
    const unsigned char *at;
    size_t left;
} page_reader;

static const unsigned char *take(page_reader *reader, size_t bytes)
{
    if (bytes > reader->left)
    {
        return NULL;
    }
    const unsigned char *from = reader->at;
    reader->at += bytes;
    reader->left -= bytes;
    return from;
}

static int is_form(unsigned form)
{
    return form == CM_BLOCK_EVEN || form == CM_BLOCK_BITS_1 || form == CM_BLOCK_BITS_2 ||
           form == CM_BLOCK_BITS_4 || form == CM_BLOCK_BYTES;
}

static cm_status read_colors(page_reader *reader, cm_region *region, unsigned block, size_t colors)
{
    const unsigned char *from = take(reader, 4 * colors);
    if (from == NULL || colors == 0)
    {
        return CM_ERROR_DATA;
    }
    if (region->color == NULL)
    {
        region->color = calloc(CM_REGION_BLOCKS, sizeof *region->color);
    }
    uint32_t *color = region->color == NULL ? NULL : cm_array_of(colors, sizeof *color);
    if (color == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    for (size_t i = 0; i < colors; i++)
    {
        color[i] = get_word(from + 4 * i);
    }
    region->color[block] = color;
    region->bytes += colors * sizeof *color;
    return CM_OK;
}

static cm_status read_block(page_reader *reader, cm_region *region, unsigned block)
{
    const unsigned char *head = take(reader, BLOCK_HEAD_BYTES);
    if (head == NULL)
    {
        return CM_ERROR_DATA;
    }
    const unsigned form = head[0] & 15u, detail = head[0] >> 4;
    if (!is_form(form) || detail > 3 || head[1] > 2 || (form == CM_BLOCK_EVEN && head[1] != 0))
    {
        return CM_ERROR_DATA;
    }
    region->value[block] = head[2];
    region->detail[block] = (uint8_t)detail;
    region->changed[block] = get_word(head + 3);
    if (form == CM_BLOCK_EVEN)
    {
        cm_region_mark(region, block, head[2] > CM_UNKNOWN);
        return CM_OK;
    }
    const size_t bytes = packed_bytes(form, detail);
    const unsigned char *from = take(reader, bytes);
    if (from == NULL)
    {
        return CM_ERROR_DATA;
    }
    uint8_t *alpha = malloc(bytes);
    if (alpha == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    memcpy(alpha, from, bytes);
    region->alpha[block] = alpha;
    region->form[block] = (uint8_t)form;
    region->bytes += bytes;
    const size_t colors = occupied_cells(alpha, form, cm_cell_count(detail));
    cm_region_mark(region, block, colors > 0);
    if (head[1] == 0)
    {
        return CM_OK;
    }
    if (head[1] == 2 && colors > 0)
    {
        region->one_color[block / 8] |= (uint8_t)(1u << block % 8);
        return read_colors(reader, region, block, 1);
    }
    return read_colors(reader, region, block, colors);
}

static cm_status read_region(page_reader *reader, const uint32_t place[3], cm_region *region)
{
    const unsigned char *head = take(reader, HEAD_BYTES);
    for (int axis = 0; axis < 3; axis++)
    {
        if (head == NULL || get_word(head + 4 * axis) != place[axis])
        {
            return CM_ERROR_DATA;
        }
    }
    cm_status status = CM_OK;
    for (unsigned block = 0; status == CM_OK && block < CM_REGION_BLOCKS; block++)
    {
        status = read_block(reader, region, block);
    }
    return status == CM_OK && reader->left > 0 ? CM_ERROR_DATA : status;
}

cm_status cm_page_get(const cm_octree *octree, cm_store *store, const uint32_t place[3],
                      cm_region **region)
{
    (void)octree;
    unsigned char bytes_of_key[9];
    key_of(place, bytes_of_key);
    const cm_store_key key = {bytes_of_key, sizeof bytes_of_key};
    cm_blob blob = {.size = sizeof blob};
    cm_status status = cm_store_get(store, &key, PAGE_KIND, PAGE_VERSION, &blob);
    if (status != CM_OK)
    {
        return status;
    }
    if (blob.data == NULL)
    {
        return CM_ERROR_DATA;
    }
    cm_region *got = cm_region_make(place, CM_UNKNOWN);
    page_reader reader = {blob.data, blob.count};
    status = got == NULL ? CM_ERROR_MEMORY : read_region(&reader, place, got);
    cm_blob_clear(&blob);
    if (status != CM_OK)
    {
        cm_region_drop(got);
        return status;
    }
    got->is_dirty = 0;
    got->has_page = 1;
    *region = got;
    return CM_OK;
}
