/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "command.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "failure.h"
#include <cubemap/number.h>

static const char *long_name(const struct option *option, int value)
{
    for (; option->name != NULL; option++)
    {
        if (option->val == value)
        {
            return option->name;
        }
    }
    return "?";
}

_Noreturn void die_of_option(const struct option *long_options, int result, char **argv)
{
    const char *const argument = argv[optind - 1];
    const char *const help = "; see " PROGRAM " --help";
    if (result == ':')
    {
        die(EXIT_USAGE, "--%s needs an argument%s", long_name(long_options, optopt), help);
    }
    if (optopt != 0 && strncmp(argument, "--", 2) == 0)
    {
        die(EXIT_USAGE, "--%s takes no argument%s", long_name(long_options, optopt), help);
    }
    if (optopt != 0)
    {
        die(EXIT_USAGE, "there is no option -%c%s", optopt, help);
    }
    die(EXIT_USAGE, "there is no option %s, or it is short for several%s", argument, help);
}

void close_standard_output(void)
{
    if (fflush(stdout) != 0 || ferror(stdout) != 0 || close(STDOUT_FILENO) != 0)
    {
        die(EXIT_FAILURE, "cannot write to standard output: %s", strerror(errno));
    }
}

_Noreturn void print_and_exit(const char *text)
{
    fputs(text, stdout);
    close_standard_output();
    exit(EXIT_SUCCESS);
}

int parse_digits(const char *text)
{
    double value;
    if (!cm_number_parse(text, strlen(text), &value) ||
        !(value >= 1 && value <= CM_NUMBER_DIGITS) || value != floor(value))
    {
        die(EXIT_USAGE, "--digits is '%s', not a whole number from 1 to %d", text,
            CM_NUMBER_DIGITS);
    }
    return (int)value;
}

const char *parse_file(int count, char **operand)
{
    if (count > 1)
    {
        die(EXIT_USAGE, "one FILE at most, but '%s' follows '%s'", operand[1], operand[0]);
    }
    return count == 1 && strcmp(operand[0], "-") != 0 ? operand[0] : NULL;
}

cm_latitude parse_latitude(const char *option, const char *name)
{
    cm_latitude latitude = CM_LATITUDE_GEOGRAPHIC;
    if (cm_latitude_find(name, &latitude) != CM_OK)
    {
        char known[256] = "";
        for (int i = 0; i < CM_LATITUDE_COUNT; i++)
        {
            const size_t length = strlen(known);
            snprintf(known + length, sizeof known - length, "%s%s", i == 0 ? "" : ", ",
                     cm_latitude_name((cm_latitude)i));
        }
        die(EXIT_USAGE, "%s is '%s', not one of %s", option, name, known);
    }
    return latitude;
}
