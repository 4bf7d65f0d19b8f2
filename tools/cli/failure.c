/* SPDX-License-Identifier: MIT */
#include "failure.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Whatever words of a user are in it: nothing that ends the line or that a terminal acts upon. */
static void write_line(FILE *stream, char *text)
{
    for (char *at = text; *at != '\0'; at++)
    {
        if ((unsigned char)*at < ' ' || *at == 0x7f)
        {
            *at = '?';
        }
    }
    fprintf(stream, "%s\n", text);
}

bool fail(cm_failure *failure, int status, const char *format, ...)
{
    va_list arguments;
    if (failure->status == 0)
    {
        va_start(arguments, format);
        vsnprintf(failure->text, sizeof failure->text, format, arguments);
        va_end(arguments);
        failure->status = status;
    }
    return false;
}

void say(FILE *stream, const char *format, ...)
{
    char text[FAILURE_TEXT_MAX + 256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    write_line(stream, text);
}

int end_program(const char *program, const cm_streams *streams, const cm_failure *failure,
                int status)
{
    if (failure->status != 0)
    {
        say(streams->err, "%s: %s", program, failure->text);
        return failure->status;
    }
    if (fflush(streams->out) != 0 || ferror(streams->out) != 0)
    {
        say(streams->err, "%s: cannot write to standard output: %s", program, strerror(errno));
        return EXIT_FAILURE;
    }
    return status;
}
