/* SPDX-License-Identifier: MIT
 *
 * What the command lines of the filters have in common.
 */
#ifndef TOOLS_CLI_COMMAND_H
#define TOOLS_CLI_COMMAND_H

#include <cubemap/latitude.h>

#include "failure.h"
#include "nearest.h"
#include "option_table.h"

/* Keeps the reader's message if usage was wrong: false if it was. */
bool check_usage(const cm_option_reader *reader, int result, cm_failure *failure);

/* The FILE among the operands, of which there is one at most; NULL for standard input. */
bool take_file(int count, char **operand, const char **name, cm_failure *failure);

/* Keeps the message of wrong usage, with the name that was meant, and returns false. */
PRINTF_LIKE(3, 4)
bool fail_nearest(cm_failure *failure, const cm_nearest *nearest, const char *format, ...);

/* Keeps "OPTION is 'NAME', not one of ...", and which of them was meant, and returns false. */
bool fail_name(cm_failure *failure, const char *option, const char *name,
               const char *(*name_at)(size_t index));

/* The latitude of a name, which the option has. */
bool take_latitude(const char *option, const char *name, cm_latitude *latitude,
                   cm_failure *failure);

#endif
