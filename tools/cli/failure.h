/* SPDX-License-Identifier: MIT
 *
 * How a program says what is wrong. What ends the work is kept as a value, and said once, where the program ends.
 */
#ifndef TOOLS_CLI_FAILURE_H
#define TOOLS_CLI_FAILURE_H

#include <stdbool.h>

#include "streams.h"

/* the exit status of wrong usage; everything else is EXIT_FAILURE */
#define EXIT_USAGE 2

#define PRINTF_LIKE(position, first) __attribute__((format(printf, position, first)))

enum
{
    FAILURE_TEXT_MAX = 8192
};

/* status is 0 as long as nothing is wrong. */
typedef struct cm_failure
{
    int status;
    char text[FAILURE_TEXT_MAX];
} cm_failure;

/* Keeps what is wrong, and returns false; the first failure stays. */
PRINTF_LIKE(3, 4) bool fail(cm_failure *failure, int status, const char *format, ...);

/* One line; control characters in it become question marks. */
PRINTF_LIKE(2, 3) void say(FILE *stream, const char *format, ...);

/* The end of a program: what was wrong is said, or what was written is flushed, which can fail. Returns the exit
 * status, which is the given one where nothing was wrong. */
int end_program(const char *program, const cm_streams *streams, const cm_failure *failure,
                int status);

#endif
