/* SPDX-License-Identifier: MIT
 *
 * A program's options stand once, in a table. From it come the parsing of the command line, the text of --help, the
 * options of the man page, and what shells complete.
 *
 *     static const cm_option options[] = {
 *         {.id = 'm', .letter = 'm', .name = "mapping", .kind = CM_OPTION_TEXT, .argument = "MAPPING",
 *          .help = "the mapping; see --list", .standard = "coupled"},
 *         {.id = 'q', .name = "quiet", .help = "print nothing but errors"},
 *     };
 *     static const cm_option_group groups[] = {{NULL, options, 2}};
 *     static const cm_command command = {.name = "cubemap-x", .usage = "[OPTION]... [FILE]", .groups = groups,
 *                                        .group_count = 1, ...};
 *
 *     cm_option_reader reader = cm_options_begin(&command, argc, argv, streams);
 *     for (int id; (id = cm_options_next(&reader)) > 0;)
 *         ... reader.text, reader.number, reader.choice ...
 *     if (id == CM_OPTIONS_WRONG) ... reader.message; exit status 2
 *
 * Texts for people (help, more, summary, notes) have `WORD` for what is to be typed as it is; --help leaves the
 * quotation marks away, the man page makes it bold. There the options that a text names become bold, too, and
 * words of capitals that stand in the option's argument, the usage or words of the command become slanted.
 *
 * Every command has --help (-h) and --version, and, in full only and not listed, --completion bash|zsh|fish and --man,
 * which print what is installed with the program.
 */
#ifndef TOOLS_CLI_OPTION_TABLE_H
#define TOOLS_CLI_OPTION_TABLE_H

#include <stddef.h>
#include <stdio.h>

#include "streams.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What an option's argument is. */
typedef enum cm_option_kind
{
    CM_OPTION_NONE,   /* there is none */
    CM_OPTION_TEXT,   /* any text; what is listed among choices is completed */
    CM_OPTION_FILE,   /* the name of a file */
    CM_OPTION_NUMBER, /* a number from low to high; an infinite high is no limit */
    CM_OPTION_WHOLE,  /* a whole number from low to high */
    CM_OPTION_CHOICE  /* one of the choices */
} cm_option_kind;

/* Bits of flags. */
enum
{
    CM_OPTION_OPTIONAL = 1, /* the argument may be left away; if not, it is --NAME=ARGUMENT */
    CM_OPTION_HIDDEN = 2,   /* not listed, and understood in full only */
    CM_OPTION_TOLD = 4,     /* help names the choices, or the range, itself */
    CM_OPTION_ABOVE = 8     /* low itself is not allowed */
};

typedef struct cm_option
{
    int id;           /* above 0, what cm_options_next returns */
    char letter;      /* -L; 0 for none */
    const char *name; /* --NAME, without the dashes */
    cm_option_kind kind;
    const char *argument; /* as people read it, such as LEVEL[:CURVE] */
    const char *help; /* a phrase without a full stop; range, choices and default are added to it */
    const char *more; /* sentences for the man page alone; NULL for none */
    const char *standard; /* what holds without the option, in words; NULL to say nothing */
    double low;
    double high;
    const char *const *choices;             /* up to NULL; or, if there are none, */
    const char *(*choice_at)(size_t index); /* NULL behind the last */
    unsigned flags;
} cm_option;

typedef struct cm_option_group
{
    const char *heading; /* "Lines"; NULL for none */
    const cm_option *options;
    size_t count;
} cm_option_group;

typedef struct cm_command
{
    const char *name;    /* cubemap-bench; for a command of it, cubemap-bench advise */
    const char *usage;   /* what follows the name; lines apart by \n are other ways to call it */
    const char *summary; /* paragraphs before the options */
    const cm_option_group *groups;
    size_t group_count;
    const char *notes;      /* paragraphs behind the options, examples at last; NULL for none */
    const char *words;      /* apart by blanks: what the man page slants besides; NULL for none */
    cm_option_kind operand; /* for completion: NONE, FILE, or TEXT, which has */
    const char *const *choices; /* those; or */
    const char *(*choice_at)(size_t index);
    const struct cm_command *const
        *commands;    /* that the first operand can name, up to NULL; NULL for none */
    int bare_version; /* --version does not name the library, as the image programs never did */
} cm_command;

enum
{
    CM_OPTIONS_END = 0,    /* the operands are known */
    CM_OPTIONS_WRONG = -1, /* wrong usage: see message */
    CM_OPTIONS_PRINTED =
        -2, /* --help or the like has been written, and nothing else is to be done */
    CM_OPTIONS_MESSAGE = 1024
};

typedef struct cm_option_reader
{
    const cm_option *option; /* the last one */
    const char *text;        /* its argument as it stands there; NULL if there is none */
    double number;           /* its value, if it is a number */
    size_t choice;           /* its index among the choices, if it is one */
    int operand_count;       /* known at the end */
    char **operands;
    char message[CM_OPTIONS_MESSAGE]; /* what is wrong, one line, without the program's name */
    /* the reader's own */
    const cm_command *command;
    const cm_streams *streams;
    int argc;
    char **argv;
    int position;
    int first_operand;
    const char *bundle; /* of letters, what is left of it */
} cm_option_reader;

/* argv[0] is the program. The order of argv changes as with getopt: at the end the operands stand behind the
 * options. */
cm_option_reader cm_options_begin(const cm_command *command, int argc, char **argv,
                                  const cm_streams *streams);

/* The id of the next option, which is above 0, or one of CM_OPTIONS_... */
int cm_options_next(cm_option_reader *reader);

/* A message "--NAME is 'TEXT', not WHAT" about the last option, for what the table cannot tell, and
 * CM_OPTIONS_WRONG. */
int cm_options_refuse(cm_option_reader *reader, const char *what);

/* The text of --help; the man page's entries of options; and completion for a shell, which is bash, zsh or fish.
 * Errors are left in the stream's error indicator. */
void cm_options_write_help(FILE *stream, const cm_command *command);
void cm_options_write_manual(FILE *stream, const cm_command *command);
void cm_options_write_completion(FILE *stream, const cm_command *command, const char *shell);

/* For those that go over a table: the options of a command one after another, --help and --version last; NULL behind
 * them. */
const cm_option *cm_options_at(const cm_command *command, size_t index);

/* A choice of an option, or NULL behind the last. */
const char *cm_option_choice_at(const cm_option *option, size_t index);

#ifdef __cplusplus
}
#endif

#endif
