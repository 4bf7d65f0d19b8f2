/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "harness.h"

#include <stdarg.h>
#include <unistd.h>

enum
{
    BAR_WIDTH = 30
};

/* Is it time for another line? */
static int is_due(int must)
{
    static double last;
    if (!isatty(fileno(harness_err())) || (!must && seconds() - last < 0.1))
    {
        return 0;
    }
    last = seconds();
    return 1;
}

void progress(const char *format, ...)
{
    va_list arguments;
    if (!is_due(format == NULL))
    {
        return;
    }
    fputs("\r\033[K", harness_err());
    if (format != NULL)
    {
        va_start(arguments, format);
        vfprintf(harness_err(), format, arguments);
        va_end(arguments);
    }
    fflush(harness_err());
}

void progress_bar(double done, double total, const char *text)
{
    char bar[BAR_WIDTH + 1];
    double part = total > 0.0 ? done / total : 0.0;
    if (!is_due(0))
    {
        return;
    }
    for (int i = 0; i < BAR_WIDTH; i++)
    {
        bar[i] = (i + 0.5) / BAR_WIDTH < part ? '#' : '.';
    }
    bar[BAR_WIDTH] = '\0';
    fprintf(harness_err(), "\r\033[K[%s] %3.0f %%  %s", bar, 100.0 * part, text);
    fflush(harness_err());
}
