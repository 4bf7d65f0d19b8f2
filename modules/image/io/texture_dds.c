/* SPDX-License-Identifier: MIT
 *
 * DDS: Microsoft, "Programming Guide for DDS": DDS_HEADER, DDS_PIXELFORMAT, DDS_HEADER_DXT10. Faces follow each other, each
 * with all its levels from the largest.
 */
#include "texture_format.h"

enum
{
    HEAD_SIZE = 4 + 124 + 20,
    FLAGS = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000, /* caps, height, width, pitch, pixel format */
    FLAG_LEVELS = 0x20000,
    CAPS_TEXTURE = 0x1000,
    CAPS_COMPLEX = 0x8,
    CAPS_LEVELS = 0x400000,
    CAPS2_CUBE = 0xfe00, /* a cube map, and each of its faces */
    DIMENSION_2D = 3,
    MISC_CUBE = 4,
    ALPHA_STRAIGHT = 1,
    ALPHA_MULTIPLIED = 2
};

cm_status cm_dds_write_head(const cm_image_stream *stream, const cm_texture *texture, char *message)
{
    const bool cube = texture->faces == 6;
    const bool levels = texture->levels > 1;
    const cm_texture_numbers *const numbers = &cm_texture_formats[texture->format];
    unsigned char head[HEAD_SIZE] = {'D', 'D', 'S', ' '};
    cm_file_put_u32(head + 4, 124);
    cm_file_put_u32(head + 8, FLAGS | (levels ? FLAG_LEVELS : 0));
    cm_file_put_u32(head + 12, texture->height);
    cm_file_put_u32(head + 16, texture->width);
    cm_file_put_u32(head + 20, texture->width * numbers->texel_size);
    cm_file_put_u32(head + 28, levels ? texture->levels : 1);
    cm_file_put_u32(head + 76, 32); /* DDS_PIXELFORMAT: its size, a code of four letters, DX10 */
    cm_file_put_u32(head + 80, 4);
    memcpy(head + 84, "DX10", 4);
    cm_file_put_u32(head + 108, (uint32_t)CAPS_TEXTURE | (levels ? CAPS_LEVELS : 0) |
                                    (levels || cube ? CAPS_COMPLEX : 0));
    cm_file_put_u32(head + 112, cube ? CAPS2_CUBE : 0);
    cm_file_put_u32(head + 128, numbers->dxgi);
    cm_file_put_u32(head + 132, DIMENSION_2D);
    cm_file_put_u32(head + 136, cube ? MISC_CUBE : 0);
    cm_file_put_u32(head + 140, 1);
    cm_file_put_u32(head + 144, texture->alpha_multiplied ? ALPHA_MULTIPLIED : ALPHA_STRAIGHT);
    return cm_file_put(stream, head, sizeof head)
               ? CM_OK
               : cm_file_fail(message, "cannot be written: no more bytes are taken");
}

static cm_status format_of(const unsigned char *head, cm_texture *texture, char *message)
{
    const uint32_t dxgi = cm_file_u32(head + 128);
    for (unsigned i = 0; i < CM_TEXTURE_FORMATS; i++)
    {
        if (cm_texture_formats[i].dxgi == dxgi)
        {
            texture->format = (cm_texture_format)i;
            return CM_OK;
        }
    }
    return cm_file_fail(message,
                        "is a DDS file of the DXGI format %lu, which is not read: 2, 10, 11, 28 "
                        "and 29 are",
                        (unsigned long)dxgi);
}

static cm_status parse(const unsigned char *head, cm_texture *texture, char *message)
{
    if (cm_file_u32(head + 4) != 124 || cm_file_u32(head + 76) != 32)
    {
        return cm_file_fail(message, "is a damaged DDS file: its header has another size");
    }
    if ((cm_file_u32(head + 80) & 4) == 0 || memcmp(head + 84, "DX10", 4) != 0)
    {
        return cm_file_fail(message, "is a DDS file without the DX10 header, which is not read");
    }
    if (cm_file_u32(head + 132) != DIMENSION_2D || cm_file_u32(head + 140) != 1)
    {
        return cm_file_fail(message,
                            "is a DDS file of an array or of other than two dimensions, which is "
                            "not read");
    }
    const cm_status status = format_of(head, texture, message);
    const uint32_t levels = cm_file_u32(head + 28);
    texture->height = cm_file_u32(head + 12);
    texture->width = cm_file_u32(head + 16);
    texture->levels = levels == 0 ? 1 : levels;
    texture->faces = (cm_file_u32(head + 136) & MISC_CUBE) != 0 ? 6 : 1;
    texture->alpha_multiplied = (cm_file_u32(head + 144) & 7) == ALPHA_MULTIPLIED;
    memcpy(texture->orientation, "rd", 3);
    return status;
}

cm_status cm_dds_open(const cm_image_stream *stream, cm_texture *texture, char *message)
{
    unsigned char head[HEAD_SIZE];
    stream->seek(stream->context, 0);
    if (!cm_file_take(stream, head, sizeof head))
    {
        return cm_file_fail(message, "is a DDS file that ends in its header");
    }
    cm_status status = parse(head, texture, message);
    status = status == CM_OK ? cm_texture_check(texture, message) : status;
    if (status != CM_OK)
    {
        return CM_ERROR_UNSUPPORTED;
    }
    uint64_t at = HEAD_SIZE;
    for (uint32_t level = 0; level < texture->levels; level++)
    {
        texture->offsets[level] = at;
        at += cm_texture_face_size(texture, level);
    }
    texture->face_step = at - HEAD_SIZE;
    const uint64_t needed = HEAD_SIZE + texture->face_step * texture->faces;
    if (stream->size(stream->context) < needed)
    {
        return cm_file_fail(message, "is a DDS file that ends too early: of %llu bytes it has %llu",
                            (unsigned long long)needed,
                            (unsigned long long)stream->size(stream->context));
    }
    return CM_OK;
}
