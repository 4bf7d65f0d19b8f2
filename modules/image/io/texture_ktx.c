/* SPDX-License-Identifier: MIT
 *
 * KTX 2.0: Khronos, "KTX File Format Specification", version 2.0, section 3 (header, level index, key/value data, mip
 * levels from the smallest, each aligned to the least common multiple of a texel and 4), and "Khronos Data Format
 * Specification" 1.3, section 5 (basic descriptor block).
 */
#include "texture_format.h"

enum
{
    HEAD_SIZE = 80,
    LEVEL_SIZE = 24,
    SAMPLES = 4,
    BLOCK_SIZE = 24 + 16 * SAMPLES, /* of the descriptor, without its total size */
    DESCRIPTOR_SIZE = 4 + BLOCK_SIZE,
    WRITER_MOST = 256,
    KEY_ROOM = 32, /* with its size and padding */
    KEYS_MOST = 4 * KEY_ROOM + WRITER_MOST + 2 * CM_TEXTURE_TEXT,
    MODEL_RGBSDA = 1,
    PRIMARIES_BT709 = 1,
    TRANSFER_LINEAR = 1,
    TRANSFER_SRGB = 2,
    FLAG_MULTIPLIED = 1,
    CHANNEL_ALPHA = 15,
    SAMPLE_LINEAR = 0x10, /* not by the transfer function: alpha beside sRGB */
    SAMPLE_SIGNED_FLOAT = 0xc0
};

static const unsigned char identifier[12] = {0xab, 'K',  'T',  'X',  ' ',  '2',
                                             '0',  0xbb, '\r', '\n', 0x1a, '\n'};

static const char rotation_key[] = "cubemap:rotation";
static const char surface_key[] = "cubemap:surface";

static uint32_t aligned(uint32_t at, uint32_t to)
{
    return (at + to - 1) / to * to;
}

static void describe_samples(const cm_texture *texture, unsigned char *to)
{
    const cm_texture_numbers *const numbers = &cm_texture_formats[texture->format];
    const uint32_t bits = numbers->texel_size * 8 / SAMPLES;
    const bool floating = numbers->type == CM_PIXEL_HALF || numbers->type == CM_PIXEL_FLOAT;
    for (uint32_t i = 0; i < SAMPLES; i++, to += 16)
    {
        const uint32_t channel = i == 3 ? CHANNEL_ALPHA : i;
        const uint32_t curve =
            i == 3 && texture->format == CM_TEXTURE_RGBA8_SRGB ? SAMPLE_LINEAR : 0;
        const uint32_t kind = channel | curve | (floating ? SAMPLE_SIGNED_FLOAT : 0);
        cm_file_put_u32(to, i * bits | (bits - 1) << 16 | kind << 24);
        cm_file_put_u32(to + 4, 0);
        /* -1 and 1 as floats, or the whole numbers that are 0 and 1 */
        cm_file_put_u32(to + 8, floating ? 0xbf800000 : 0);
        cm_file_put_u32(to + 12, floating ? 0x3f800000 : (UINT32_C(1) << bits) - 1);
    }
}

static void describe_format(const cm_texture *texture, unsigned char to[DESCRIPTOR_SIZE])
{
    const uint32_t transfer =
        texture->format == CM_TEXTURE_RGBA8_SRGB ? TRANSFER_SRGB : TRANSFER_LINEAR;
    memset(to, 0, DESCRIPTOR_SIZE);
    cm_file_put_u32(to, DESCRIPTOR_SIZE);
    cm_file_put_u32(to + 8, 2 | (uint32_t)BLOCK_SIZE << 16); /* version 1.3 */
    cm_file_put_u32(to + 12, MODEL_RGBSDA | PRIMARIES_BT709 << 8 | transfer << 16 |
                                 (texture->alpha_multiplied ? (uint32_t)FLAG_MULTIPLIED << 24 : 0));
    cm_file_put_u32(to + 20, cm_texture_formats[texture->format].texel_size); /* bytesPlane0 */
    describe_samples(texture, to + 28);
}

/* One key with its value and zero bytes up to four. */
static uint32_t put_key(unsigned char *to, const char *key, const char *value)
{
    const size_t key_size = strlen(key) + 1;
    const size_t value_size = strlen(value) + 1;
    const uint32_t size = (uint32_t)(key_size + value_size);
    cm_file_put_u32(to, size);
    memcpy(to + 4, key, key_size);
    memcpy(to + 4 + key_size, value, value_size);
    memset(to + 4 + size, 0, aligned(size, 4) - size);
    return 4 + aligned(size, 4);
}

/* The header and the index of levels, with where they begin. */
static size_t put_index(const cm_texture *texture, uint32_t keys_size, unsigned char *to,
                        uint64_t *offsets)
{
    const cm_texture_numbers *const numbers = &cm_texture_formats[texture->format];
    const uint32_t index_end = HEAD_SIZE + LEVEL_SIZE * texture->levels;
    const uint32_t words[] = {numbers->vulkan,
                              (uint32_t)cm_file_sample_size(numbers->type),
                              texture->width,
                              texture->height,
                              0, /* depth */
                              0, /* layers: no array */
                              texture->faces,
                              texture->levels,
                              0, /* no supercompression */
                              index_end,
                              DESCRIPTOR_SIZE,
                              index_end + DESCRIPTOR_SIZE,
                              keys_size};
    memset(to, 0, index_end);
    memcpy(to, identifier, sizeof identifier);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
    {
        cm_file_put_u32(to + 12 + 4 * i, words[i]);
    }
    /* texels of 4, 8 and 16 bytes are multiples of 4, and so is every level */
    uint64_t at = aligned(index_end + DESCRIPTOR_SIZE + keys_size, numbers->texel_size);
    for (uint32_t level = texture->levels; level-- > 0;)
    {
        unsigned char *const entry = to + HEAD_SIZE + (size_t)LEVEL_SIZE * level;
        const uint64_t size = cm_texture_face_size(texture, level) * texture->faces;
        cm_file_put_u64(entry, at);
        cm_file_put_u64(entry + 8, size);
        cm_file_put_u64(entry + 16, size);
        offsets[level] = at;
        at += size;
    }
    return index_end;
}

cm_status cm_ktx_write_head(const cm_image_stream *stream, const cm_texture *texture,
                            uint64_t offsets[CM_TEXTURE_LEVELS_MOST], uint64_t *end, char *message)
{
    unsigned char head[HEAD_SIZE + LEVEL_SIZE * CM_TEXTURE_LEVELS_MOST];
    unsigned char descriptor[DESCRIPTOR_SIZE];
    unsigned char keys[KEYS_MOST];
    if (texture->writer != NULL && strlen(texture->writer) >= WRITER_MOST)
    {
        cm_file_fail(message, "cannot be written: the writer's name has more than %d bytes",
                     WRITER_MOST - 1);
        return CM_ERROR_ARGUMENT;
    }
    if (memchr(texture->surface, '\0', CM_TEXTURE_TEXT) == NULL ||
        memchr(texture->rotation, '\0', CM_TEXTURE_TEXT) == NULL)
    {
        cm_file_fail(message, "cannot be written: what it says of the sphere has no end");
        return CM_ERROR_ARGUMENT;
    }
    /* by their code points, as the specification asks */
    uint32_t keys_size = put_key(keys, "KTXorientation", "rd");
    keys_size +=
        texture->writer != NULL ? put_key(keys + keys_size, "KTXwriter", texture->writer) : 0;
    keys_size += texture->rotation[0] != '\0'
                     ? put_key(keys + keys_size, rotation_key, texture->rotation)
                     : 0;
    keys_size +=
        texture->surface[0] != '\0' ? put_key(keys + keys_size, surface_key, texture->surface) : 0;
    describe_format(texture, descriptor);
    const size_t head_size = put_index(texture, keys_size, head, offsets);
    if (!cm_file_put(stream, head, head_size) ||
        !cm_file_put(stream, descriptor, sizeof descriptor) ||
        !cm_file_put(stream, keys, keys_size))
    {
        return cm_file_fail(message, "cannot be written: no more bytes are taken");
    }
    *end = head_size + sizeof descriptor + keys_size;
    return CM_OK;
}

/* ---- reading ---- */

static cm_status format_of(const unsigned char *head, cm_texture *texture, char *message)
{
    const uint32_t vulkan = cm_file_u32(head + 12);
    for (unsigned i = 0; i < CM_TEXTURE_FORMATS; i++)
    {
        if (cm_texture_formats[i].vulkan == vulkan)
        {
            texture->format = (cm_texture_format)i;
            return cm_file_u32(head + 16) == cm_file_sample_size(cm_texture_formats[i].type)
                       ? CM_OK
                       : cm_file_fail(message, "is a damaged KTX file: its typeSize is not that of "
                                               "its format");
        }
    }
    return cm_file_fail(message,
                        "is a KTX file of the Vulkan format %lu, which is not read: 37, 43, 91, "
                        "97 and 109 are",
                        (unsigned long)vulkan);
}

static cm_status parse(const unsigned char *head, cm_texture *texture, char *message)
{
    if (cm_file_u32(head + 44) != 0)
    {
        return cm_file_fail(message, "is a KTX file with supercompression %lu, which is not read",
                            (unsigned long)cm_file_u32(head + 44));
    }
    const cm_status status = format_of(head, texture, message);
    if (status != CM_OK)
    {
        return status;
    }
    if (cm_file_u32(head + 24) == 0 || cm_file_u32(head + 28) != 0 || cm_file_u32(head + 32) > 1)
    {
        return cm_file_fail(message, "is a KTX file of an array or of other than two dimensions, "
                                     "which is not read");
    }
    const uint32_t levels = cm_file_u32(head + 40);
    texture->width = cm_file_u32(head + 20);
    texture->height = cm_file_u32(head + 24);
    texture->faces = cm_file_u32(head + 36);
    texture->levels = levels == 0 ? 1 : levels; /* 0: the reader is to make the others */
    return cm_texture_check(texture, message);
}

static bool is_inside(uint64_t at, uint64_t length, uint64_t begin, uint64_t size)
{
    return at >= begin && at <= size && length <= size - at;
}

static cm_status parse_levels(const unsigned char *index, uint64_t size, cm_texture *texture,
                              char *message)
{
    for (uint32_t level = 0; level < texture->levels; level++)
    {
        const unsigned char *const entry = index + (size_t)LEVEL_SIZE * level;
        const uint64_t length = cm_texture_face_size(texture, level) * texture->faces;
        const uint64_t begin = HEAD_SIZE + (uint64_t)LEVEL_SIZE * texture->levels;
        texture->offsets[level] = cm_file_u64(entry);
        if (cm_file_u64(entry + 8) != length || cm_file_u64(entry + 16) != length)
        {
            return cm_file_fail(message, "is a damaged KTX file: level %lu is not %llu bytes long",
                                (unsigned long)level, (unsigned long long)length);
        }
        if (!is_inside(texture->offsets[level], length, begin, size))
        {
            return cm_file_fail(message,
                                "is a KTX file that ends too early: level %lu is not in "
                                "it",
                                (unsigned long)level);
        }
    }
    return CM_OK;
}

static cm_status read_orientation(const unsigned char *value, uint32_t size, cm_texture *texture,
                                  char *message)
{
    if (size != 3 || (value[0] != 'r' && value[0] != 'l') || (value[1] != 'd' && value[1] != 'u') ||
        value[2] != '\0')
    {
        return cm_file_fail(message, "is a damaged KTX file: KTXorientation is not one of "
                                     "rd, ru, ld, lu");
    }
    memcpy(texture->orientation, value, 3);
    return CM_OK;
}

/* A text that has room is taken; others say nothing to us. */
static void read_text(const unsigned char *value, uint32_t size, char *text)
{
    if (size <= CM_TEXTURE_TEXT && size > 0 && value[size - 1] == '\0')
    {
        memcpy(text, value, size);
    }
}

/* The value's size if the entry of so many bytes is of that key, else 0. */
static uint32_t size_of_value(const unsigned char *entry, uint32_t size, const char *key)
{
    const uint32_t length = (uint32_t)strlen(key) + 1;
    return size > length && memcmp(entry, key, length) == 0 ? size - length : 0;
}

static cm_status parse_entry(const unsigned char *entry, uint32_t size, cm_texture *texture,
                             char *message)
{
    static const char orientation[] = "KTXorientation";
    uint32_t value = size_of_value(entry, size, surface_key);
    if (value > 0)
    {
        read_text(entry + sizeof surface_key, value, texture->surface);
    }
    value = size_of_value(entry, size, rotation_key);
    if (value > 0)
    {
        read_text(entry + sizeof rotation_key, value, texture->rotation);
    }
    value = size_of_value(entry, size, orientation);
    const int is_it =
        size >= sizeof orientation && memcmp(entry, orientation, sizeof orientation) == 0;
    return is_it ? read_orientation(entry + sizeof orientation, value, texture, message) : CM_OK;
}

static cm_status parse_keys(const cm_image_stream *stream, uint32_t at, uint32_t length,
                            cm_texture *texture, char *message)
{
    for (uint32_t done = 0; done < length;)
    {
        unsigned char entry[4 + KEY_ROOM + CM_TEXTURE_TEXT];
        const uint32_t left = length - done;
        const size_t some = left < sizeof entry ? left : sizeof entry;
        memset(entry, 0, sizeof entry);
        stream->seek(stream->context, (int64_t)at + done);
        if (left < 4 || !cm_file_take(stream, entry, some) || cm_file_u32(entry) > left - 4 ||
            cm_file_u32(entry) < 2)
        {
            return cm_file_fail(message, "is a damaged KTX file: its key/value data is too short");
        }
        const uint32_t size = cm_file_u32(entry);
        const cm_status status = parse_entry(entry + 4, size, texture, message);
        if (status != CM_OK)
        {
            return status;
        }
        const uint32_t rest = left - 4 - size;
        const uint32_t padding = (4 - size % 4) % 4;
        done += 4 + size + (padding < rest ? padding : rest);
    }
    return CM_OK;
}

static cm_status parse_descriptor(const cm_image_stream *stream, uint32_t at, uint32_t length,
                                  cm_texture *texture, char *message)
{
    unsigned char begin[4 + 24];
    stream->seek(stream->context, at);
    if (length < sizeof begin || !cm_file_take(stream, begin, sizeof begin) ||
        cm_file_u32(begin) != length)
    {
        return cm_file_fail(message, "is a damaged KTX file: its data format descriptor has "
                                     "another size");
    }
    texture->alpha_multiplied = (begin[15] & FLAG_MULTIPLIED) != 0;
    return CM_OK;
}

cm_status cm_ktx_open(const cm_image_stream *stream, cm_texture *texture, char *message)
{
    unsigned char head[HEAD_SIZE];
    unsigned char index[LEVEL_SIZE * CM_TEXTURE_LEVELS_MOST];
    const uint64_t size = stream->size(stream->context);
    stream->seek(stream->context, 0);
    if (!cm_file_take(stream, head, sizeof head))
    {
        return cm_file_fail(message, "is a KTX file that ends in its header");
    }
    if (memcmp(head, identifier, sizeof identifier) != 0)
    {
        return cm_file_fail(message, "is no KTX file of version 2.0, or a damaged one");
    }
    if (parse(head, texture, message) != CM_OK)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    if (!cm_file_take(stream, index, (size_t)LEVEL_SIZE * texture->levels))
    {
        return cm_file_fail(message, "is a KTX file that ends in its index of levels");
    }
    const uint64_t begin = HEAD_SIZE + (uint64_t)LEVEL_SIZE * texture->levels;
    const uint32_t place[4] = {cm_file_u32(head + 48), cm_file_u32(head + 52),
                               cm_file_u32(head + 56), cm_file_u32(head + 60)};
    if (!is_inside(place[0], place[1], begin, size) ||
        (place[3] != 0 && !is_inside(place[2], place[3], begin, size)))
    {
        return cm_file_fail(message,
                            "is a KTX file that ends too early, in what it says of itself");
    }
    cm_status status = parse_levels(index, size, texture, message);
    status =
        status == CM_OK ? parse_descriptor(stream, place[0], place[1], texture, message) : status;
    return status == CM_OK ? parse_keys(stream, place[2], place[3], texture, message) : status;
}
