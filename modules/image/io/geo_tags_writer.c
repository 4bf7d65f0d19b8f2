/* SPDX-License-Identifier: MIT
 *
 * TIFF 6.0, section 2, and BigTIFF: the first directory is written again at the end of the file, with the tags in it, and
 * the header then points there. OpenImageIO cannot write these tags.
 */
#include "geo_tags.h"

#include "file_words.h"

#include <stdlib.h>

enum
{
    TYPE_SHORT = 3,
    TYPE_DOUBLE = 12,
    TAG_COUNT = 3,
    ENTRIES_MOST = 4096
};

/* A file that is changed. */
typedef struct tiff
{
    const cm_image_stream *stream;
    bool little;
    size_t wide; /* the bytes of offsets and counts: 4, and 8 of BigTIFF */
} tiff;

typedef struct tag
{
    uint16_t number;
    uint16_t type;
    size_t count;
    size_t size; /* of a number */
    const void *content;
} tag;

static void put_number(const tiff *t, unsigned char *to, size_t size, uint64_t number)
{
    for (size_t i = 0; i < size; i++)
    {
        to[t->little ? i : size - 1 - i] = (unsigned char)(number >> 8 * i);
    }
}

static uint64_t number_at(const tiff *t, const unsigned char *from, size_t size)
{
    uint64_t number = 0;
    for (size_t i = 0; i < size; i++)
    {
        number = number << 8 | from[t->little ? size - 1 - i : i];
    }
    return number;
}

static bool read_at(const tiff *t, uint64_t place, void *bytes, size_t count)
{
    t->stream->seek(t->stream->context, (int64_t)place);
    return place <= INT64_MAX && cm_file_take(t->stream, bytes, count);
}

static bool write_at(const tiff *t, uint64_t place, const void *bytes, size_t count)
{
    t->stream->seek(t->stream->context, (int64_t)place);
    return place <= INT64_MAX && cm_file_put(t->stream, bytes, count);
}

static size_t count_size(const tiff *t)
{
    return t->wide == 8 ? 8 : 2;
}

static size_t entry_size(const tiff *t)
{
    return 4 + 2 * t->wide;
}

/* Where the directory's offset stands in the header; 0 if this is no TIFF. */
static uint64_t begin(tiff *t)
{
    unsigned char head[4];
    if (!read_at(t, 0, head, sizeof head) || head[0] != head[1] ||
        (head[0] != 'I' && head[0] != 'M'))
    {
        return 0;
    }
    t->little = head[0] == 'I';
    const uint64_t magic = number_at(t, head + 2, 2);
    t->wide = magic == 43 ? 8 : 4;
    return magic == 42 ? 4 : magic == 43 ? 8 : 0;
}

/* The content at the end of the file, at an even place. */
static bool write_content(const tiff *t, const tag *of, uint64_t *end)
{
    unsigned char bytes[8];
    *end += *end % 2;
    t->stream->seek(t->stream->context, (int64_t)*end);
    for (size_t i = 0; i < of->count; i++)
    {
        uint64_t number = 0;
        uint16_t narrow = 0;
        if (of->size == sizeof narrow)
        {
            memcpy(&narrow, (const unsigned char *)of->content + i * of->size, sizeof narrow);
            number = narrow;
        }
        else
        {
            memcpy(&number, (const unsigned char *)of->content + i * of->size, sizeof number);
        }
        put_number(t, bytes, of->size, number);
        if (!cm_file_put(t->stream, bytes, of->size))
        {
            return false;
        }
    }
    *end += of->count * of->size;
    return true;
}

static void write_entry(const tiff *t, unsigned char *entry, const tag *of, uint64_t place)
{
    put_number(t, entry, 2, of->number);
    put_number(t, entry + 2, 2, of->type);
    put_number(t, entry + 4, t->wide, of->count);
    put_number(t, entry + 4 + t->wide, t->wide, place);
}

/* The old entries and ours, in the order of their numbers. Returns how many there are. */
static size_t merge(const tiff *t, const unsigned char *old, size_t old_count, const tag *tags,
                    const uint64_t *places, unsigned char *to)
{
    const size_t size = entry_size(t);
    size_t next = 0;
    size_t count = 0;
    for (size_t i = 0; i <= old_count; i++)
    {
        const uint64_t number = i < old_count ? number_at(t, old + i * size, 2) : UINT32_MAX;
        for (; next < TAG_COUNT && tags[next].number <= number; next++)
        {
            write_entry(t, to + count++ * size, &tags[next], places[next]);
        }
        const bool replaced = next > 0 && tags[next - 1].number == number;
        if (i < old_count && !replaced)
        {
            memcpy(to + count++ * size, old + i * size, size);
        }
    }
    return count;
}

/* From the directory at a place, of so many entries, to a new one; block has room for both. */
static bool move_directory(const tiff *t, uint64_t place, size_t count, const tag *tags,
                           unsigned char *block, uint64_t *moved)
{
    const size_t head = count_size(t);
    const size_t size = entry_size(t);
    uint64_t places[TAG_COUNT];
    uint64_t end = t->stream->size(t->stream->context);
    for (size_t i = 0; i < TAG_COUNT; i++)
    {
        end += end % 2;
        places[i] = end;
        if (!write_content(t, &tags[i], &end))
        {
            return false;
        }
    }
    end += end % 8 == 0 ? 0 : 8 - end % 8;
    *moved = end;
    unsigned char *const old = block;
    unsigned char *const fresh = block + count * size + t->wide;
    if (!read_at(t, place + head, old, count * size + t->wide))
    {
        return false;
    }
    const size_t all = merge(t, old, count, tags, places, fresh + head);
    put_number(t, fresh, head, all);
    memcpy(fresh + head + all * size, old + count * size, t->wide); /* the next directory */
    return (t->wide == 8 || end + head + all * size + t->wide <= UINT32_MAX) &&
           write_at(t, end, fresh, head + all * size + t->wide);
}

cm_status cm_geo_tags_write(const cm_image_stream *stream, const cm_image_geo_tags *geo,
                            char *message)
{
    if (stream == NULL || geo == NULL || geo->scale == NULL || geo->tie_points == NULL ||
        geo->keys == NULL)
    {
        cm_file_fail(message, "cannot be placed: there is no place");
        return CM_ERROR_ARGUMENT;
    }
    const tag tags[TAG_COUNT] = {{33550, TYPE_DOUBLE, geo->scale_count, 8, geo->scale},
                                 {33922, TYPE_DOUBLE, geo->tie_point_count, 8, geo->tie_points},
                                 {34735, TYPE_SHORT, geo->key_count, 2, geo->keys}};
    tiff t = {.stream = stream};
    unsigned char number[8];
    const uint64_t header = begin(&t);
    if (header == 0 || !read_at(&t, header, number, t.wide))
    {
        return cm_file_fail(message, "cannot be placed: it is no TIFF file");
    }
    const uint64_t place = number_at(&t, number, t.wide);
    if (!read_at(&t, place, number, count_size(&t)) ||
        number_at(&t, number, count_size(&t)) > ENTRIES_MOST)
    {
        return cm_file_fail(message, "cannot be placed: it has no directory");
    }
    const size_t count = (size_t)number_at(&t, number, count_size(&t));
    unsigned char *const block =
        malloc((2 * count + TAG_COUNT) * entry_size(&t) + 2 * t.wide + count_size(&t));
    if (block == NULL)
    {
        return CM_ERROR_MEMORY;
    }
    uint64_t moved = 0;
    bool good = move_directory(&t, place, count, tags, block, &moved);
    if (good)
    {
        put_number(&t, number, t.wide, moved);
        good = write_at(&t, header, number, t.wide);
    }
    free(block);
    return good ? CM_OK
                : cm_file_fail(message, "cannot be placed: its directory cannot be written");
}
