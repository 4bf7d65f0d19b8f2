/* SPDX-License-Identifier: MIT
 *
 * A stream in memory: bytes that are read, or room that is written to and then reads.
 */
#ifndef TESTS_MEMORY_STREAM_H
#define TESTS_MEMORY_STREAM_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef struct memory_stream
{
    unsigned char *bytes;
    size_t size; /* bytes there are */
    size_t room; /* bytes there may be */
    size_t at;
} memory_stream;

static inline size_t memory_read(void *context, void *bytes, size_t count)
{
    memory_stream *const memory = context;
    const size_t left = memory->at < memory->size ? memory->size - memory->at : 0;
    const size_t some = count < left ? count : left;
    if (some > 0)
    {
        memcpy(bytes, memory->bytes + memory->at, some);
    }
    memory->at += some;
    return some;
}

static inline size_t memory_write(void *context, const void *bytes, size_t count)
{
    memory_stream *const memory = context;
    const size_t left = memory->at < memory->room ? memory->room - memory->at : 0;
    const size_t some = count < left ? count : left;
    if (some > 0)
    {
        memcpy(memory->bytes + memory->at, bytes, some);
    }
    memory->at += some;
    memory->size = memory->at > memory->size ? memory->at : memory->size;
    return some;
}

static inline void memory_seek(void *context, int64_t position)
{
    ((memory_stream *)context)->at = (size_t)position;
}

static inline size_t memory_size(void *context)
{
    return ((memory_stream *)context)->size;
}

/* It as a cm_image_stream, whose header the includer has. */
#define stream_of(memory)                                                                          \
    ((cm_image_stream){(memory), memory_read, memory_write, memory_seek, memory_size})

#endif
