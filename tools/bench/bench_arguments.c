/* SPDX-License-Identifier: MIT
 *
 * What the parts of cubemap-bench share of reading arguments and of saying what is wrong with them.
 */
#include "bench.h"

#include <getopt.h>
#include <stdlib.h>
#include <string.h>

int usage(const char *what, const char *text)
{
    fprintf(stderr, "%s: %s%s; see --help\n", program_name(), what, text);
    return 2;
}

int usage_of(const char *option, const char *argument, const char *right)
{
    fprintf(stderr, "%s: --%s cannot be '%s', but %s; see --help\n", program_name(), option,
            argument, right);
    return 2;
}

int read_number(const char *text, double low, double high, double *value)
{
    char *end;
    double read = strtod(text, &end);
    if (end == text || *end != '\0' || !(read >= low && read <= high))
    {
        return 0;
    }
    *value = read;
    return 1;
}

int find_word(const char *text, const char *const *words)
{
    for (int i = 0; words[i] != NULL; i++)
    {
        if (strcmp(text, words[i]) == 0)
        {
            return i;
        }
    }
    return -1;
}

const char *option_name(const struct option *options, int value)
{
    while (options->name != NULL && options->val != value)
    {
        options++;
    }
    return options->name;
}
