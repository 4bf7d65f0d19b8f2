/* SPDX-License-Identifier: MIT
 *
 * What the command lines of the filters have in common.
 */
#ifndef CUBEMAP_TOOLS_COMMAND_H
#define CUBEMAP_TOOLS_COMMAND_H

#include <cubemap/latitude.h>

#include <getopt.h>

/* What getopt_long reports without words: result is '?' or ':', optopt and optind are its own. */
_Noreturn void die_of_option(const struct option *long_options, int result, char **argv);

/* Ends the program if what was written did not arrive. */
void close_standard_output(void);

_Noreturn void print_and_exit(const char *text);

/* The argument of --digits, from 1 to 17; else wrong usage. */
int parse_digits(const char *text);

/* The FILE among the operands, of which there is one at most; NULL for standard input. */
const char *parse_file(int count, char **operand);

/* The latitude of a name, which the option has. */
cm_latitude parse_latitude(const char *option, const char *name);

#endif
