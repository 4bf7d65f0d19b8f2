/* SPDX-License-Identifier: MIT
 *
 * Numbers in files, byte by byte, so that neither alignment nor the machine's own order of bytes counts; streams that
 * give all that is asked or nothing; messages.
 */
#ifndef CUBEMAP_MODULES_IMAGE_FILE_WORDS_H
#define CUBEMAP_MODULES_IMAGE_FILE_WORDS_H

#include <string.h>

#include "image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Write the message, cut to CM_IMAGE_MESSAGE bytes; characters that do not print become "?". Always
 * CM_ERROR_UNSUPPORTED. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
cm_status
cm_file_fail(char *message, const char *format, ...);

/* All of count bytes, from where the stream is. */
bool cm_file_take(const cm_image_stream *stream, void *bytes, size_t count);
bool cm_file_put(const cm_image_stream *stream, const void *bytes, size_t count);

/* So many zero bytes. */
bool cm_file_pad(const cm_image_stream *stream, size_t count);

/* Turn samples of 1, 2, 4 or 8 bytes from the file's order of bytes into the machine's, or back. */
void cm_file_order(void *samples, size_t count, size_t sample_size, bool little_endian);

/* The bytes of a sample; 0 for what is no type. */
static inline size_t cm_file_sample_size(cm_pixel_type type)
{
    switch (type)
    {
    case CM_PIXEL_U8:
        return 1;
    case CM_PIXEL_U16:
    case CM_PIXEL_HALF:
        return 2;
    case CM_PIXEL_FLOAT:
        return 4;
    default:
        return 0;
    }
}

static inline void cm_file_put_u32(unsigned char *to, uint32_t value)
{
    for (unsigned i = 0; i < 4; i++)
    {
        to[i] = (unsigned char)(value >> 8 * i);
    }
}

static inline void cm_file_put_u64(unsigned char *to, uint64_t value)
{
    cm_file_put_u32(to, (uint32_t)value);
    cm_file_put_u32(to + 4, (uint32_t)(value >> 32));
}

static inline uint32_t cm_file_u32(const unsigned char *from)
{
    return (uint32_t)from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 |
           (uint32_t)from[3] << 24;
}

static inline uint64_t cm_file_u64(const unsigned char *from)
{
    return cm_file_u32(from) | (uint64_t)cm_file_u32(from + 4) << 32;
}

#ifdef __cplusplus
}
#endif

#endif
