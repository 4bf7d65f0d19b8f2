/* SPDX-License-Identifier: MIT
 *
 * What the figures are of: the program, the machine, the system, the compiler.
 */
#define _POSIX_C_SOURCE 200809L

#include "harness.h"

#include <cubemap/number.h>

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

static const char *name_of_program = "";

void name_program(const char *name)
{
    name_of_program = name;
}

const char *program_name(void)
{
    return name_of_program;
}

double number_of(const char *word)
{
    double value = NAN;
    cm_number_parse(word, strlen(word), &value);
    return value;
}

/* The rest of the line of a file that begins with a key, or "". */
static void line_of(const char *file, const char *key, char *text, size_t size)
{
    char line[256];
    FILE *in = fopen(file, "r");
    text[0] = '\0';
    while (in != NULL && text[0] == '\0' && fgets(line, sizeof line, in) != NULL)
    {
        if (strncmp(line, key, strlen(key)) == 0)
        {
            const char *rest = line + strlen(key);
            rest += strspn(rest, " \t:");
            snprintf(text, size, "%.*s", (int)strcspn(rest, "\n"), rest);
        }
    }
    if (in != NULL)
    {
        fclose(in);
    }
}

const char *system_cpu(void)
{
    static char text[200];
    struct utsname name;
    line_of("/proc/cpuinfo", "model name", text, sizeof text);
    if (text[0] == '\0' && uname(&name) == 0)
    {
        snprintf(text, sizeof text, "%s", name.machine);
    }
    return text;
}

const char *system_name(void)
{
    static char text[sizeof(struct utsname)];
    struct utsname name;
    if (uname(&name) == 0)
    {
        snprintf(text, sizeof text, "%s, %s", name.sysname, name.machine);
    }
    return text;
}

const char *system_compiler(void)
{
#if defined(__clang__)
    return __VERSION__;
#elif defined(__GNUC__)
    return "gcc " __VERSION__;
#else
    return "unknown";
#endif
}

const char *system_flags(void)
{
    return BUILD_FLAGS;
}

double system_free_memory(void)
{
    char text[64];
    double kilobytes = 0.0;
    line_of("/proc/meminfo", "MemAvailable", text, sizeof text);
    return cm_number_read(text, strlen(text), &kilobytes) > 0 ? kilobytes * 1024.0 : 0.0;
}
