/* SPDX-License-Identifier: MIT
 *
 * What the texts that are made of a table of options share.
 */
#ifndef TOOLS_CLI_OPTION_TEXT_H
#define TOOLS_CLI_OPTION_TEXT_H

#include "option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

enum
{
    OPTION_RANGE_MAX = 96,
    OPTION_TEXT_MAX = 4096 /* of one option's or one paragraph's text */
};

/* A list that ends with NULL, or a function that does; NULL behind the last. */
const char *option_choice(const char *const *choices, const char *(*choice_at)(size_t),
                          size_t index);

/* Of the table alone, without what every command has. */
size_t option_count(const cm_command *command);

/* "a whole number from 1 to 17" */
void option_range(const cm_option *option, char text[OPTION_RANGE_MAX]);

/* "geo, gl or s2", "one of geo, gl, fits, s2" */
void option_choices(const char *const *choices, const char *(*choice_at)(size_t),
                    char text[OPTION_TEXT_MAX]);

/* Help, and what the table knows: the range, the choices. The default follows, too, if that is wanted. */
void option_help(const cm_option *option, int with_default, char text[OPTION_TEXT_MAX]);

/* The same for a single line, cut where its first clause ends, without quotation marks. */
void option_summary(const cm_option *option, char text[OPTION_TEXT_MAX]);

/* The paragraphs of a text, one a call; those whose line begins with a blank are each one line and to be printed as
 * they are. NULL behind the last; *text moves on. */
const char *next_paragraph(const char **text, size_t *length);

/* Words of bytes at text, to a column; the first line begins at the given one. Marks are left away. */
void write_filled(FILE *stream, const char *text, size_t length, size_t indent, size_t at,
                  size_t width);

#ifdef __cplusplus
}
#endif

#endif
