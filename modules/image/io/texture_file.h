/* SPDX-License-Identifier: MIT
 *
 * Textures for renderers: DDS with the DX10 header, and KTX 2.0; a picture or the six faces of a cube, with levels, not
 * compressed, four channels.
 *
 *   faces       in the order +X -X +Y -Y +Z -Z, as the files have them
 *   levels      0 is the largest; the files' levels halve rounding down, the pictures of mips.h rounding up: they are the
 *               same for cm_texture_levels levels, all if the size is a power of two
 *   message     as in image_io.h; must not be NULL
 *   example     cm_texture t = {.size = sizeof t, .container = CM_TEXTURE_KTX2, .format = CM_TEXTURE_RGBA8_SRGB,
 *                               .width = 512, .height = 512, .faces = 6, .levels = cm_mips_count(mips)};
 *               const cm_image *levels[CM_TEXTURE_LEVELS_MOST];
 *               for (uint32_t l = 0; l < t.levels; l++) levels[l] = cm_mips_pictures(mips, l);
 *               cm_texture_write(&stream, &t, levels, message);
 */
#ifndef CUBEMAP_MODULES_IMAGE_TEXTURE_FILE_H
#define CUBEMAP_MODULES_IMAGE_TEXTURE_FILE_H

#include "image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Pixels along an edge, and levels, at most. */
#define CM_TEXTURE_SIZE_MOST 1048576
#define CM_TEXTURE_LEVELS_MOST 21

/* Room for what a file says of the sphere. */
#define CM_TEXTURE_TEXT 256

/* The kind of file. */
typedef enum cm_texture_container
{
    CM_TEXTURE_DDS = 0, /* DirectDraw Surface with DDS_HEADER_DXT10 */
    CM_TEXTURE_KTX2 = 1 /* Khronos texture, version 2.0 */
} cm_texture_container;

/* What a texel is: four channels, red, green, blue, alpha. */
typedef enum cm_texture_format
{
    CM_TEXTURE_RGBA8 = 0,      /* CM_PIXEL_U8, proportional to light */
    CM_TEXTURE_RGBA8_SRGB = 1, /* CM_PIXEL_U8, with sRGB's curve */
    CM_TEXTURE_RGBA16 = 2,     /* CM_PIXEL_U16 */
    CM_TEXTURE_RGBA16F = 3,    /* CM_PIXEL_HALF */
    CM_TEXTURE_RGBA32F = 4     /* CM_PIXEL_FLOAT */
} cm_texture_format;

/* A texture in a file. */
typedef struct cm_texture
{
    size_t size; /* sizeof(cm_texture) */
    cm_texture_container container;
    cm_texture_format format;
    uint32_t width;       /* of level 0, in pixels, to CM_TEXTURE_SIZE_MOST */
    uint32_t height;      /* the same; of a cube that of the width */
    uint32_t faces;       /* 1, or 6 for a cube */
    uint32_t levels;      /* 1 to as many as there are down to 1 x 1 */
    int alpha_multiplied; /* are colours multiplied by alpha? */
    const char *
        writer; /* KTX: what wrote it, "cubemap-reproject 1.0", less than 256 bytes; NULL: not said. Read: NULL */
    char surface[CM_TEXTURE_TEXT]; /* KTX: the key cubemap:surface, a specification; "": none */
    char rotation
        [CM_TEXTURE_TEXT]; /* KTX: the key cubemap:rotation, as in orientation.h; "": none */
    char orientation[4];   /* read from KTX: "rd", "ru"; "" if it does not say. DDS: "rd" */
    uint64_t offsets[CM_TEXTURE_LEVELS_MOST]; /* read: where the first face of a level is */
    uint64_t face_step;                       /* read from DDS: from one face to the next */
} cm_texture;

/* The type of a format's samples. */
cm_pixel_type cm_texture_type(cm_texture_format format);

/* How many levels of a picture of this size have the same size rounded up and rounded down; at most
 * CM_TEXTURE_LEVELS_MOST. */
uint32_t cm_texture_levels(uint32_t width, uint32_t height);

/* Write all of a file, from the stream's begin on, without seeking: levels[l] points to the faces of level l. Pictures
 * have the format's type, and 1 (grey), 2 (grey, alpha), 3 (red, green, blue) or 4 channels; alpha without a channel is 1.
 * CM_ERROR_ARGUMENT: a pointer or a member that is none. CM_ERROR_RANGE: pictures of another size, type or number of
 * channels. CM_ERROR_MEMORY. CM_ERROR_UNSUPPORTED: the stream took no more. All with a message. */
cm_status cm_texture_write(const cm_image_stream *stream, const cm_texture *texture,
                           const cm_image *const *levels, char *message);

/* Read what a file says, and check that all of its pixels are there. CM_ERROR_ARGUMENT; CM_ERROR_UNSUPPORTED: no such
 * file, a format that is none of these, or a file that is damaged. */
cm_status cm_texture_open(const cm_image_stream *stream, cm_texture *texture, char *message);

/* The rows of a face of a level, four channels each, from a file that cm_texture_open has read. row_stride is in bytes
 * and may be negative; 0: dense. CM_ERROR_ARGUMENT: no such level or face; CM_ERROR_UNSUPPORTED: the stream ended. */
cm_status cm_texture_read(const cm_image_stream *stream, const cm_texture *texture, uint32_t level,
                          uint32_t face, void *pixels, ptrdiff_t row_stride, char *message);

#ifdef __cplusplus
}
#endif

#endif
