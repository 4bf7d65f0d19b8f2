/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "geo_tags.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Nobody writes more bytes into one of these tags. */
#define TAG_BYTES_MAX (1U << 20)

/* TIFF 6.0, section 2; BigTIFF has numbers of 8 bytes where TIFF has 4 or 2. */
typedef struct tiff
{
    FILE *file;
    bool little;
    bool big;
    bool cut; /* a directory was read, of which a tag that counts goes on beyond the file's end */
} tiff;

enum
{
    TYPE_BYTE = 1,
    TYPE_ASCII = 2,
    TYPE_SHORT = 3,
    TYPE_UNDEFINED = 7,
    TYPE_DOUBLE = 12,
    TAG_DESCRIPTION = 270,
    TAG_XMP = 700,
    TAG_COUNT = 7
};

typedef struct geo_tag
{
    uint16_t number;
    uint16_t type;
} geo_tag;

/* In the order of their room in the block: what needs the widest alignment first. */
static const geo_tag wanted[TAG_COUNT] = {
    {33550, TYPE_DOUBLE}, {33922, TYPE_DOUBLE}, {34264, TYPE_DOUBLE}, {34736, TYPE_DOUBLE},
    {34735, TYPE_SHORT},  {34737, TYPE_ASCII},  {42113, TYPE_ASCII}};

/* Where a tag's content stands. */
typedef struct place
{
    uint64_t offset;
    uint64_t count; /* of numbers, 0: there is none */
} place;

static size_t size_of_type(uint16_t type)
{
    return type == TYPE_DOUBLE ? 8 : type == TYPE_SHORT ? 2 : 1;
}

static bool read_at(const tiff *t, uint64_t offset, void *bytes, size_t count)
{
    return offset <= INT64_MAX && fseeko(t->file, (off_t)offset, SEEK_SET) == 0 &&
           fread(bytes, 1, count, t->file) == count;
}

/* The unsigned number of so many bytes. */
static uint64_t number_of(const tiff *t, const unsigned char *bytes, size_t count)
{
    uint64_t number = 0;
    for (size_t i = 0; i < count; i++)
    {
        number = number << 8 | bytes[t->little ? count - 1 - i : i];
    }
    return number;
}

static bool read_number(const tiff *t, uint64_t offset, size_t count, uint64_t *number)
{
    unsigned char bytes[8];
    if (!read_at(t, offset, bytes, count))
    {
        return false;
    }
    *number = number_of(t, bytes, count);
    return true;
}

/* Is there a byte at this place? */
static bool is_there(const tiff *t, uint64_t offset)
{
    unsigned char byte;
    return read_at(t, offset, &byte, 1);
}

/* Does an entry that is one of those that are wanted, or a text, have content that is not in the file? */
static bool is_cut(const tiff *t, const unsigned char *entry)
{
    const size_t wide = t->big ? 8 : 4;
    const uint64_t number = number_of(t, entry, 2);
    const uint64_t type = number_of(t, entry + 2, 2);
    const uint64_t count = number_of(t, entry + 4, wide);
    const bool bytes = type == TYPE_BYTE || type == TYPE_ASCII || type == TYPE_UNDEFINED;
    bool counts = bytes && (number == TAG_DESCRIPTION || number == TAG_XMP);
    for (size_t i = 0; i < TAG_COUNT; i++)
    {
        counts = counts || (number == wanted[i].number && type == wanted[i].type);
    }
    const uint64_t size = size_of_type((uint16_t)type);
    if (!counts || count <= wide / size)
    {
        return false;
    }
    const uint64_t offset = number_of(t, entry + 4 + wide, wide);
    return count > INT64_MAX / size || offset > INT64_MAX ||
           !is_there(t, offset + count * size - 1);
}

/* Where the first directory stands, or 0. */
static uint64_t first_directory(tiff *t)
{
    unsigned char head[4];
    if (!read_at(t, 0, head, 4) || head[0] != head[1] || (head[0] != 'I' && head[0] != 'M'))
    {
        return 0;
    }
    t->little = head[0] == 'I';
    const uint64_t magic = number_of(t, head + 2, 2);
    t->big = magic == 43;
    uint64_t offset = 0;
    return (magic == 42 || magic == 43) && read_number(t, t->big ? 8 : 4, t->big ? 8 : 4, &offset)
               ? offset
               : 0;
}

/* One entry of a directory: notes where it stands if it is one of those that are wanted. */
static void note_entry(const tiff *t, const unsigned char *entry, uint64_t at,
                       place places[TAG_COUNT])
{
    const size_t wide = t->big ? 8 : 4;
    const uint64_t number = number_of(t, entry, 2);
    const uint64_t type = number_of(t, entry + 2, 2);
    const uint64_t count = number_of(t, entry + 4, wide);
    for (size_t i = 0; i < TAG_COUNT; i++)
    {
        if (number != wanted[i].number || type != wanted[i].type || count == 0 ||
            count > TAG_BYTES_MAX / size_of_type(wanted[i].type))
        {
            continue;
        }
        const bool inside = count * size_of_type(wanted[i].type) <= wide;
        places[i].count = count;
        places[i].offset = inside ? at + 4 + wide : number_of(t, entry + 4 + wide, wide);
    }
}

/* Reads a directory; false if it is damaged. *next is where the one behind it stands, or 0. */
static bool read_directory(tiff *t, uint64_t offset, place places[TAG_COUNT], uint64_t *next)
{
    const size_t count_size = t->big ? 8 : 2;
    const size_t entry_size = t->big ? 20 : 12;
    uint64_t count = 0;
    /* tags are numbers of 16 bits: no directory has more of them */
    if (!read_number(t, offset, count_size, &count) || count > 65536)
    {
        return false;
    }
    memset(places, 0, TAG_COUNT * sizeof *places);
    bool cut = false;
    offset += count_size;
    for (uint64_t i = 0; i < count; i++, offset += entry_size)
    {
        unsigned char entry[20];
        if (!read_at(t, offset, entry, entry_size))
        {
            return false;
        }
        note_entry(t, entry, offset, places);
        cut = cut || is_cut(t, entry);
    }
    t->cut = cut;
    return read_number(t, offset, t->big ? 8 : 4, next);
}

/* The directory of a picture; false if there is none. */
static bool find_directory(tiff *t, uint32_t subimage, place places[TAG_COUNT])
{
    uint64_t offset = first_directory(t);
    for (uint32_t i = 0; offset != 0 && i <= subimage; i++)
    {
        uint64_t next = 0;
        if (!read_directory(t, offset, places, &next))
        {
            return false;
        }
        if (i == subimage)
        {
            return true;
        }
        offset = next;
    }
    return false;
}

/* The content of a tag, in this machine's order of bytes. */
static bool read_content(const tiff *t, const place *from, uint16_t type, unsigned char *to)
{
    const size_t size = size_of_type(type);
    const size_t count = (size_t)from->count;
    if (!read_at(t, from->offset, to, count * size))
    {
        return false;
    }
    for (size_t i = 0; i < count && size > 1; i++)
    {
        const uint64_t bits = number_of(t, to + i * size, size);
        const uint16_t narrow = (uint16_t)bits;
        memcpy(to + i * size, size == 8 ? (const void *)&bits : (const void *)&narrow, size);
    }
    return true;
}

/* All in one block: the struct, then what it points to. */
static cm_image_geo_tags *read_contents(const tiff *t, place places[TAG_COUNT])
{
    size_t total = sizeof(cm_image_geo_tags);
    for (size_t i = 0; i < TAG_COUNT; i++)
    {
        total += (size_t)places[i].count * size_of_type(wanted[i].type) + 1;
    }
    unsigned char *const block = calloc(1, total);
    if (block == NULL)
    {
        return NULL;
    }
    void *content[TAG_COUNT] = {0};
    size_t used = sizeof(cm_image_geo_tags);
    bool any = false;
    for (size_t i = 0; i < TAG_COUNT; i++)
    {
        if (places[i].count > 0 && !read_content(t, &places[i], wanted[i].type, block + used))
        {
            places[i].count = 0;
        }
        content[i] = places[i].count > 0 ? block + used : NULL;
        any = any || content[i] != NULL;
        /* a text ends with a zero byte, whatever the file says */
        used +=
            (size_t)places[i].count * size_of_type(wanted[i].type) + (wanted[i].type == TYPE_ASCII);
        if (wanted[i].type == TYPE_ASCII)
        {
            block[used - 1] = 0;
        }
    }
    cm_image_geo_tags *const tags = (cm_image_geo_tags *)(void *)block;
    *tags = (cm_image_geo_tags){.scale = content[0],
                                .scale_count = (size_t)places[0].count,
                                .tie_points = content[1],
                                .tie_point_count = (size_t)places[1].count,
                                .transformation = content[2],
                                .transformation_count = (size_t)places[2].count,
                                .numbers = content[3],
                                .number_count = (size_t)places[3].count,
                                .keys = content[4],
                                .key_count = (size_t)places[4].count,
                                .texts = content[5],
                                .no_data = content[6]};
    if (!any)
    {
        free(block);
        return NULL;
    }
    return tags;
}

cm_image_geo_tags *cm_geo_tags_read(const char *path, uint32_t subimage)
{
    tiff t = {.file = fopen(path, "rb")};
    if (t.file == NULL)
    {
        return NULL;
    }
    place places[TAG_COUNT];
    cm_image_geo_tags *const tags =
        find_directory(&t, subimage, places) ? read_contents(&t, places) : NULL;
    fclose(t.file);
    return tags;
}

bool cm_geo_tags_are_cut(const char *path, uint32_t subimage)
{
    tiff t = {.file = fopen(path, "rb")};
    if (t.file == NULL)
    {
        return false;
    }
    place places[TAG_COUNT];
    const bool cut = find_directory(&t, subimage, places) && t.cut;
    fclose(t.file);
    return cut;
}
