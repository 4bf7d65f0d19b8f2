/* SPDX-License-Identifier: MIT
 *
 * The streams of a program that is called as a function: its input is a text, its output and its messages are kept.
 */
#ifndef TESTS_FUZZ_TALK_H
#define TESTS_FUZZ_TALK_H

#include "fuzz_streams.h"

#include "tools/cli/streams.h"

/* To be given to close_streams, and what was written then to drop_talk. */
static inline cm_streams open_streams(talk *with, const void *text, size_t size)
{
    /* a stream of memory is not empty */
    FILE *in = size > 0 ? fmemopen((void *)(uintptr_t)text, size, "r") : fopen("/dev/null", "r");
    const cm_streams streams = {in, open_memstream(&with->output, &with->output_size),
                                open_memstream(&with->messages, &with->messages_size)};
    EXPECT(in != NULL && streams.out != NULL && streams.err != NULL, "no memory");
    return streams;
}

static inline void close_streams(const cm_streams *streams)
{
    fclose(streams->in);
    EXPECT(fclose(streams->out) == 0 && fclose(streams->err) == 0, "no memory");
}

#endif
