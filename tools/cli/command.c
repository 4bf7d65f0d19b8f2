/* SPDX-License-Identifier: MIT */
#include "command.h"

#include <stdarg.h>
#include <string.h>

#include "catalogue_name.h"
#include "option_text.h"

bool check_usage(const cm_option_reader *reader, int result, cm_failure *failure)
{
    return result != CM_OPTIONS_WRONG || fail(failure, EXIT_USAGE, "%s", reader->message);
}

bool take_file(int count, char **operand, const char **name, cm_failure *failure)
{
    if (count > 1)
    {
        return fail(failure, EXIT_USAGE, "one FILE at most, but '%s' follows '%s'", operand[1],
                    operand[0]);
    }
    *name = count == 1 && strcmp(operand[0], "-") != 0 ? operand[0] : NULL;
    return true;
}

bool fail_nearest(cm_failure *failure, const cm_nearest *nearest, const char *format, ...)
{
    char text[FAILURE_TEXT_MAX];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    cm_nearest_append(nearest, text, sizeof text);
    return fail(failure, EXIT_USAGE, "%s", text);
}

bool fail_name(cm_failure *failure, const char *option, const char *name,
               const char *(*name_at)(size_t index))
{
    char known[OPTION_TEXT_MAX];
    const cm_nearest nearest = nearest_name(name, name_at);
    option_choices(NULL, name_at, known);
    fail(failure, EXIT_USAGE, "%s is '%s', not %s", option, name, known);
    cm_nearest_append(&nearest, failure->text, sizeof failure->text);
    return false;
}

bool take_latitude(const char *option, const char *name, cm_latitude *latitude, cm_failure *failure)
{
    return cm_latitude_find(name, latitude) == CM_OK ||
           fail_name(failure, option, name, latitude_name_at);
}
