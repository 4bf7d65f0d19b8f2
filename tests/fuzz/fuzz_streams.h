/* SPDX-License-Identifier: MIT
 *
 * The standard streams of a tool that runs inside a harness: its input is a text, its output and
 * its messages are kept. Needs a C library whose stdout and stderr are variables, as glibc's are.
 */
#ifndef TESTS_FUZZ_STREAMS_H
#define TESTS_FUZZ_STREAMS_H

#include <sys/mman.h>
#include <unistd.h>

#include "fuzz.h"

/* What a tool has written. To be freed with drop_talk. */
typedef struct talk
{
    char *output;   /* the stream stdout, then the descriptor 1 */
    char *messages; /* stderr */
    size_t output_size;
    size_t messages_size;
    FILE *own_stdout;
    FILE *own_stderr;
} talk;

/* Puts files without a name in the place of the descriptors 0 and 1. libFuzzer talks on stderr. */
static inline void replace_descriptors(void)
{
    int input = memfd_create("input", 0);
    int output = memfd_create("output", 0);
    EXPECT(input > 2 && output > 2 && dup2(input, 0) == 0 && dup2(output, 1) == 1, "no files");
}

static inline void set_input(const void *text, size_t size)
{
    EXPECT(ftruncate(0, 0) == 0 && pwrite(0, text, size, 0) == (ssize_t)size &&
               lseek(0, 0, SEEK_SET) == 0 && ftruncate(1, 0) == 0 && lseek(1, 0, SEEK_SET) == 0,
           "no input");
}

static inline void begin_talk(talk *with)
{
    with->own_stdout = stdout;
    with->own_stderr = stderr;
    FILE *output = open_memstream(&with->output, &with->output_size);
    FILE *messages = open_memstream(&with->messages, &with->messages_size);
    EXPECT(output != NULL && messages != NULL, "no memory");
    stdout = output;
    stderr = messages;
}

static inline void end_talk(talk *with)
{
    FILE *output = stdout;
    FILE *messages = stderr;
    off_t size = lseek(1, 0, SEEK_END);
    stdout = with->own_stdout;
    stderr = with->own_stderr;
    char *written = (char *)malloc((size_t)size + 1);
    EXPECT(written != NULL && pread(1, written, (size_t)size, 0) == size, "no output");
    EXPECT(fwrite(written, 1, (size_t)size, output) == (size_t)size, "no memory");
    EXPECT(fclose(output) == 0 && fclose(messages) == 0, "no memory");
    free(written);
}

static inline void drop_talk(talk *with)
{
    free(with->output);
    free(with->messages);
}

/* Are these lines that begin like that and have nothing in them that a terminal would act upon? */
static inline int are_messages(const char *messages, const char *beginning)
{
    for (const char *line = messages; *line != '\0'; line++)
    {
        if (strncmp(line, beginning, strlen(beginning)) != 0)
        {
            return 0;
        }
        for (; *line != '\n'; line++)
        {
            if ((unsigned char)*line < 0x20 || *line == 0x7f)
            {
                return 0;
            }
        }
    }
    return 1;
}

static inline int is_one_message(const char *messages, const char *beginning)
{
    const char *end = strchr(messages, '\n');
    return are_messages(messages, beginning) && end != NULL && end[1] == '\0';
}

#endif
