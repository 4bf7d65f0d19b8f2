/* SPDX-License-Identifier: MIT */
#include "failure.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

/* Whatever words of a user are in it: nothing that ends the line or that a terminal acts upon. */
static void write_line(const char *format, va_list arguments)
{
    char text[8192];
    vsnprintf(text, sizeof text, format, arguments);
    for (char *at = text; *at != '\0'; at++)
    {
        if ((unsigned char)*at < ' ' || *at == 0x7f)
        {
            *at = '?';
        }
    }
    fputs(text, stderr);
    fputc('\n', stderr);
}

void say(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_line(format, arguments);
    va_end(arguments);
}

_Noreturn void die(int status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs(PROGRAM ": ", stderr);
    write_line(format, arguments);
    va_end(arguments);
    exit(status);
}
