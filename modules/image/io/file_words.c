/* SPDX-License-Identifier: MIT */
#include "file_words.h"

#include <stdarg.h>
#include <stdio.h>

cm_status cm_file_fail(char *message, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, CM_IMAGE_MESSAGE, format, arguments);
    va_end(arguments);
    for (char *at = message; *at != '\0'; at++)
    {
        if ((unsigned char)*at < 0x20 || (unsigned char)*at > 0x7e)
        {
            *at = '?';
        }
    }
    return CM_ERROR_UNSUPPORTED;
}

/* Pipes give less than was asked, though more is to come. */
bool cm_file_take(const cm_image_stream *stream, void *bytes, size_t count)
{
    for (size_t done = 0; done < count;)
    {
        const size_t got =
            stream->read(stream->context, (unsigned char *)bytes + done, count - done);
        if (got == 0 || got > count - done)
        {
            return false;
        }
        done += got;
    }
    return true;
}

bool cm_file_put(const cm_image_stream *stream, const void *bytes, size_t count)
{
    for (size_t done = 0; done < count;)
    {
        const size_t put =
            stream->write(stream->context, (const unsigned char *)bytes + done, count - done);
        if (put == 0 || put > count - done)
        {
            return false;
        }
        done += put;
    }
    return true;
}

bool cm_file_pad(const cm_image_stream *stream, size_t count)
{
    static const unsigned char zeros[64] = {0};
    for (size_t done = 0; done < count;)
    {
        const size_t some = count - done < sizeof zeros ? count - done : sizeof zeros;
        if (!cm_file_put(stream, zeros, some))
        {
            return false;
        }
        done += some;
    }
    return true;
}

/* Samples of so many bytes. Called with a constant size, so that the compiler turns several at a time. */
static inline void turn(unsigned char *at, size_t count, size_t size)
{
    for (size_t i = 0; i < count; i++, at += size)
    {
        for (size_t low = 0, high = size - 1; low < high; low++, high--)
        {
            const unsigned char kept = at[low];
            at[low] = at[high];
            at[high] = kept;
        }
    }
}

void cm_file_order(void *samples, size_t count, size_t sample_size, bool little_endian)
{
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    if (little_endian == (first == 1))
    {
        return;
    }
    switch (sample_size)
    {
    case 2:
        turn(samples, count, 2);
        break;
    case 4:
        turn(samples, count, 4);
        break;
    case 8:
        turn(samples, count, 8);
        break;
    default:
        break;
    }
}
