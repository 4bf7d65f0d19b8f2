/* SPDX-License-Identifier: MIT
 *
 * A command line in the input: an argument a line, up to an empty line or the end.
 */
#ifndef TESTS_FUZZ_ARGUMENTS_H
#define TESTS_FUZZ_ARGUMENTS_H

#include "fuzz.h"

enum
{
    ARGUMENTS_MAX = 32
};

typedef struct arguments
{
    int count;
    char *argument[ARGUMENTS_MAX + 1]; /* NULL behind the last, as main has it */
    const uint8_t *rest;               /* of the input, behind the empty line */
    size_t rest_size;
} arguments;

static inline char *copy_argument(const void *text, size_t size)
{
    supply from = {(const uint8_t *)text, size};
    return take_text(&from);
}

/* To be given to drop_arguments. */
static inline arguments read_arguments(const char *program, const uint8_t *data, size_t size)
{
    arguments read = {0, {NULL}, data, size};
    read.argument[read.count++] = copy_argument(program, strlen(program));
    while (read.rest_size > 0 && read.count < ARGUMENTS_MAX)
    {
        const void *end = memchr(read.rest, '\n', read.rest_size);
        size_t length = end == NULL ? read.rest_size : (size_t)((const uint8_t *)end - read.rest);
        if (length > 0)
        {
            read.argument[read.count++] = copy_argument(read.rest, length);
        }
        read.rest += length + (end != NULL);
        read.rest_size -= length + (end != NULL);
        if (length == 0)
        {
            break;
        }
    }
    return read;
}

static inline void drop_arguments(arguments *read)
{
    for (int i = 0; i < read->count; i++)
    {
        free(read->argument[i]);
    }
}

#endif
