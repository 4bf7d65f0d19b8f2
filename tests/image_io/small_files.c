/* SPDX-License-Identifier: MIT */
#include "small_files.h"

#include <stdio.h>
#include <string.h>

typedef struct buffer
{
    unsigned char bytes[8192];
    size_t size;
    bool big_endian;
} buffer;

static void put(buffer *to, uint64_t number, size_t count)
{
    for (size_t i = 0; i < count && to->size < sizeof to->bytes; i++)
    {
        const size_t place = to->big_endian ? count - 1 - i : i;
        to->bytes[to->size++] = (unsigned char)(number >> (8 * place));
    }
}

static void put_double(buffer *to, double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    put(to, bits, 8);
}

static void put_float(buffer *to, float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    put(to, bits, 4);
}

static void put_text(buffer *to, const char *text)
{
    do
    {
        put(to, (unsigned char)*text, 1);
    } while (*text++ != '\0');
}

/* A number at a place that was left for it. */
static void put_at(buffer *to, size_t place, uint64_t number, size_t count)
{
    const size_t end = to->size;
    to->size = place;
    put(to, number, count);
    to->size = end;
}

static bool save(const char *path, const buffer *from, size_t cut)
{
    FILE *const file = fopen(path, "wb");
    bool good = file != NULL && cut <= from->size;
    good = good && fwrite(from->bytes, 1, from->size - cut, file) == from->size - cut;
    return file != NULL && fclose(file) == 0 && good;
}

/* ---------------------------------------------------------------- TIFF */

typedef struct entry
{
    uint16_t tag;
    uint16_t type;
    uint64_t count;
    uint64_t value;   /* or where it is */
    const char *text; /* of a text that may fit into the entry */
} entry;

static void put_entry(buffer *to, bool big, const entry *e)
{
    const size_t wide = big ? 8 : 4;
    const size_t size = e->type == 2 ? 1 : e->type == 3 ? 2 : e->type == 4 ? 4 : 8;
    const bool inside = e->count * size <= wide;
    put(to, e->tag, 2);
    put(to, e->type, 2);
    put(to, e->count, wide);
    const size_t end = to->size + wide;
    if (inside && e->text != NULL)
    {
        put_text(to, e->text);
    }
    else
    {
        put(to, e->value, inside ? size : wide);
    }
    put(to, 0, end - to->size);
}

/* Where they begin, one after the other: doubles of scale, tie point and number, keys, two texts. */
static void put_geo_contents(buffer *to, uint32_t page, uint64_t at[6])
{
    at[0] = to->size;
    put_double(to, page + 0.5);
    put_double(to, page + 0.25);
    put_double(to, 0);
    at[1] = to->size;
    for (int i = 0; i < 6; i++)
    {
        put_double(to, i == 3 ? -180 : i == 4 ? 90 : 0);
    }
    at[2] = to->size;
    put_double(to, 6378137);
    put_double(to, 298.25);
    at[3] = to->size;
    for (unsigned i = 0; i < 8; i++)
    {
        put(to, 1000 + i, 2);
    }
    at[4] = to->size;
    put_text(to, "WGS 84|page");
    at[5] = to->size;
    put_text(to, "-9999.5");
}

static void put_page(buffer *to, const small_tiff *what, uint32_t page, size_t link)
{
    const bool big = what->big_tiff;
    const uint64_t pixels = to->size;
    for (uint32_t i = 0; i < SMALL_WIDTH * SMALL_HEIGHT; i++)
    {
        put(to, 16 * page + i, 1);
    }
    put(to, 0, 1);
    uint64_t at[6] = {0};
    if (what->geo_tags)
    {
        put_geo_contents(to, page, at);
    }
    const entry entries[] = {{256, 3, 1, SMALL_WIDTH, NULL},
                             {257, 3, 1, SMALL_HEIGHT, NULL},
                             {258, 3, 1, 8, NULL},
                             {259, 3, 1, 1, NULL},
                             {262, 3, 1, 1, NULL},
                             {273, 4, 1, pixels, NULL},
                             {277, 3, 1, 1, NULL},
                             {278, 3, 1, SMALL_HEIGHT, NULL},
                             {279, 4, 1, SMALL_WIDTH * SMALL_HEIGHT, NULL},
                             {33550, 12, 3, at[0], NULL},
                             {33922, 12, 6, at[1], NULL},
                             {34735, 3, 8, at[3], NULL},
                             {34736, 12, 2, at[2], NULL},
                             {34737, 2, 12, at[4], NULL},
                             {42113, 2, 8, at[5], "-9999.5"}};
    const size_t count = what->geo_tags ? 15 : 9;
    put(to, 0, to->size % 8 == 0 ? 0 : 8 - to->size % 8);
    put_at(to, link, to->size, big ? 8 : 4);
    put(to, count, big ? 8 : 2);
    for (size_t i = 0; i < count; i++)
    {
        put_entry(to, big, &entries[i]);
    }
}

bool write_small_tiff(const char *path, const small_tiff *what)
{
    buffer file = {.big_endian = what->big_endian};
    put_text(&file, what->big_endian ? "MM" : "II");
    file.size = 2; /* without the zero byte */
    put(&file, what->big_tiff ? 43 : 42, 2);
    if (what->big_tiff)
    {
        put(&file, 8, 2);
        put(&file, 0, 2);
    }
    size_t link = file.size;
    put(&file, 0, what->big_tiff ? 8 : 4);
    for (uint32_t page = 0; page < what->pages; page++)
    {
        put_page(&file, what, page, link);
        link = file.size;
        put(&file, 0, what->big_tiff ? 8 : 4);
    }
    return save(path, &file, what->cut);
}

bool write_wide_tiff(const char *path, const uint32_t *numbers, uint32_t count)
{
    buffer file = {.size = 0};
    put_text(&file, "II");
    file.size = 2;
    put(&file, 42, 2);
    put(&file, 8 + 4 * (uint64_t)count, 4);
    for (uint32_t i = 0; i < count; i++)
    {
        put(&file, numbers[i], 4);
    }
    const entry entries[] = {
        {256, 3, 1, count, NULL}, {257, 3, 1, 1, NULL}, {258, 3, 1, 32, NULL},
        {259, 3, 1, 1, NULL},     {262, 3, 1, 1, NULL}, {273, 4, 1, 8, NULL},
        {277, 3, 1, 1, NULL},     {278, 3, 1, 1, NULL}, {279, 4, 1, 4 * (uint64_t)count, NULL}};
    put(&file, sizeof entries / sizeof *entries, 2);
    for (size_t i = 0; i < sizeof entries / sizeof *entries; i++)
    {
        put_entry(&file, false, &entries[i]);
    }
    put(&file, 0, 4);
    return save(path, &file, 0);
}

/* ---------------------------------------------------------------- OpenEXR */

static void put_attribute(buffer *to, const char *name, const char *type, uint32_t size)
{
    put_text(to, name);
    put_text(to, type);
    put(to, size, 4);
}

static void put_box(buffer *to, const char *name, int32_t low, int32_t right, int32_t bottom)
{
    put_attribute(to, name, "box2i", 16);
    put(to, (uint32_t)low, 4);
    put(to, (uint32_t)low, 4);
    put(to, (uint32_t)right, 4);
    put(to, (uint32_t)bottom, 4);
}

static void put_string(buffer *to, const char *name, const char *value)
{
    const size_t length = strlen(value);
    put_attribute(to, name, "string", (uint32_t)length);
    put_text(to, value);
    to->size--; /* a string has its length, no zero byte */
}

static void put_part_head(buffer *to, uint32_t part)
{
    char name[20];
    snprintf(name, sizeof name, "part%u", (unsigned)part);
    put_attribute(to, "channels", "chlist", 2 + 16 + 1);
    put_text(to, "Y");
    put(to, 2, 4); /* float */
    put(to, 0, 4);
    put(to, 1, 4);
    put(to, 1, 4);
    put(to, 0, 1);
    put_attribute(to, "compression", "compression", 1);
    put(to, 0, 1);
    put_box(to, "dataWindow", 0, SMALL_WIDTH - 1, SMALL_HEIGHT - 1);
    put_box(to, "displayWindow", -1, SMALL_WIDTH, SMALL_HEIGHT);
    put_attribute(to, "lineOrder", "lineOrder", 1);
    put(to, 0, 1);
    put_attribute(to, "pixelAspectRatio", "float", 4);
    put_float(to, 1);
    put_attribute(to, "screenWindowCenter", "v2f", 8);
    put(to, 0, 8);
    put_attribute(to, "screenWindowWidth", "float", 4);
    put_float(to, 1);
    put_string(to, "name", name);
    put_string(to, "type", "scanlineimage");
    put_attribute(to, "chunkCount", "int", 4);
    put(to, SMALL_HEIGHT, 4);
    put(to, 0, 1);
}

bool write_small_exr(const char *path, uint32_t parts)
{
    buffer file = {.size = 0};
    put(&file, 20000630, 4);
    put(&file, parts > 1 ? 2 | 0x1000 : 2, 4);
    for (uint32_t part = 0; part < parts; part++)
    {
        put_part_head(&file, part);
    }
    put(&file, 0, parts > 1 ? 1 : 0);
    size_t table = file.size;
    put(&file, 0, 0);
    for (uint32_t i = 0; i < parts * SMALL_HEIGHT; i++)
    {
        put(&file, 0, 8);
    }
    for (uint32_t part = 0; part < parts; part++)
    {
        for (uint32_t row = 0; row < SMALL_HEIGHT; row++, table += 8)
        {
            put_at(&file, table, file.size, 8);
            put(&file, part, parts > 1 ? 4 : 0);
            put(&file, row, 4);
            put(&file, SMALL_WIDTH * 4, 4);
            for (uint32_t column = 0; column < SMALL_WIDTH; column++)
            {
                put_float(&file, (float)(100 * part + row * SMALL_WIDTH + column));
            }
        }
    }
    return save(path, &file, 0);
}
