/* SPDX-License-Identifier: MIT
 *
 * The options of the programs, which are called as functions: each option of each table is parsed, told by --help,
 * the man page and completion, and refused with the one that was meant where it is misspelt.
 */
#define _POSIX_C_SOURCE 200809L

#include "tests/suite.h"

#include "tools/bench/bench_command.h"
#include "tools/cli/option_table.h"
#include "tools/latitude/cubemap_latitude.h"
#include "tools/project/project.h"
#ifdef IMAGE_PROGRAMS
#include "tools/colormap/colormap_main.h"
#include "tools/compare/compare_main.h"
#include "tools/distortion/distortion_main.h"
#include "tools/orient/orient_main.h"
#include "tools/reproject/reproject_main.h"
#endif
#ifdef SCENE_PROGRAM
#include "tools/octree/octree_main.h"
#include "tools/scene/scene_main.h"
#endif
#ifdef TOF_PROGRAM
#include "tools/tof/tof_main.h"
#endif

enum
{
    WORDS_MAX = 8
};

typedef int (*program_main)(int argc, char **argv, const cm_streams *streams);

static const struct
{
    const char *name;
    program_main call;
    const cm_command *command;
} programs[] = {
    {"cubemap-project", cm_project_main, &cm_project_command},
    {"cubemap-latitude", cm_latitude_main, &cm_latitude_command},
    {"cubemap-bench", cm_bench_main, &cm_bench_command},
#ifdef IMAGE_PROGRAMS
    {"cubemap-reproject", cm_reproject_main, &cm_reproject_command},
    {"cubemap-compare", cm_compare_main, &cm_compare_command},
    {"cubemap-distortion", cm_distortion_main, &cm_distortion_command},
    {"cubemap-orient", cm_orient_main, &cm_orient_command},
    {"cubemap-colormap", cm_colormap_main, &cm_colormap_command},
#endif
#ifdef SCENE_PROGRAM
    {"cubemap-octree", cm_octree_main, &cm_octree_command},
    {"cubemap-scene", cm_scene_main, &cm_scene_command},
#endif
#ifdef TOF_PROGRAM
    {"cubemap-tof", cm_tof_main, &cm_tof_command},
#endif
};

enum
{
    PROGRAMS = sizeof programs / sizeof *programs
};

/* What a program has written. */
typedef struct talk
{
    int status;
    char *output;
    char *messages;
} talk;

/* Calls it with some words, up to NULL; the first is the program's. */
static talk call(program_main program, const char *const *words, const char *input)
{
    talk with = {0, NULL, NULL};
    size_t sizes[2];
    char *argv[WORDS_MAX + 1] = {NULL};
    char *copies[WORDS_MAX] = {NULL};
    int argc = 0;
    for (; words[argc] != NULL; argc++)
    {
        copies[argc] = argv[argc] = strdup(words[argc]);
    }
    FILE *in = *input == '\0' ? fopen("/dev/null", "r")
                              : fmemopen((void *)(uintptr_t)input, strlen(input), "r");
    const cm_streams streams = {in, open_memstream(&with.output, &sizes[0]),
                                open_memstream(&with.messages, &sizes[1])};
    with.status = program(argc, argv, &streams);
    fclose(streams.in);
    fclose(streams.out);
    fclose(streams.err);
    for (int i = 0; i < argc; i++)
    {
        free(copies[i]);
    }
    return with;
}

static void drop(talk *with)
{
    free(with->output);
    free(with->messages);
}

/* What a command prints for an option that every command has. */
static talk ask(size_t program, const cm_command *command, const char *option, const char *argument)
{
    const char *const blank = strchr(command->name, ' ');
    const char *words[WORDS_MAX] = {programs[program].name};
    int count = 1;
    if (blank != NULL)
    {
        words[count++] = blank + 1;
    }
    words[count++] = option;
    words[count] = argument;
    return call(programs[program].call, words, "");
}

/* A program's commands, itself the first. */
static const cm_command *command_at(size_t program, size_t index)
{
    const cm_command *const whole = programs[program].command;
    return index == 0 ? whole : whole->commands == NULL ? NULL : whole->commands[index - 1];
}

/* An argument that an option takes. */
static const char *good_argument(const cm_option *option, char text[CM_NUMBER_SIZE])
{
    switch (option->kind)
    {
    case CM_OPTION_NUMBER:
    case CM_OPTION_WHOLE:
        cm_number_write(isinf(option->high) ? option->low + 1.0 : option->high, 17, text);
        return text;
    case CM_OPTION_CHOICE:
        return cm_option_choice_at(option, 0);
    default:
        return "anything";
    }
}

static int parse(const cm_command *command, const char *word, const char *argument, char *message)
{
    const cm_streams streams = {stdin, stdout, stderr};
    char *const copy = strdup(word);
    char *const second = argument != NULL ? strdup(argument) : NULL;
    char *argv[] = {copy, copy, second, NULL};
    cm_option_reader reader = cm_options_begin(command, argument != NULL ? 3 : 2, argv, &streams);
    const int id = cm_options_next(&reader);
    snprintf(message, CM_OPTIONS_MESSAGE, "%s", reader.message);
    free(copy);
    free(second);
    return id;
}

static void check_option(const cm_command *command, const cm_option *option)
{
    char word[100];
    char message[CM_OPTIONS_MESSAGE];
    char number[CM_NUMBER_SIZE];
    const char *const argument = good_argument(option, number);
    const int takes = option->kind != CM_OPTION_NONE;
    snprintf(word, sizeof word, "--%s%s%s", option->name, takes ? "=" : "", takes ? argument : "");
    ck_assert_msg(parse(command, word, NULL, message) == option->id, "%s: %s", word, message);
    if (!takes)
    {
        snprintf(word, sizeof word, "--%s=1", option->name);
        ck_assert_int_eq(parse(command, word, NULL, message), CM_OPTIONS_WRONG);
    }
    else if ((option->flags & CM_OPTION_OPTIONAL) == 0)
    {
        snprintf(word, sizeof word, "--%s", option->name);
        ck_assert_msg(parse(command, word, argument, message) == option->id, "%s: %s", word,
                      message);
        ck_assert_int_eq(parse(command, word, NULL, message), CM_OPTIONS_WRONG);
    }
    if (option->letter != '\0')
    {
        snprintf(word, sizeof word, "-%c%s", option->letter, takes ? argument : "");
        ck_assert_msg(parse(command, word, NULL, message) == option->id, "%s: %s", word, message);
    }
    if (option->kind == CM_OPTION_NUMBER || option->kind == CM_OPTION_WHOLE ||
        option->kind == CM_OPTION_CHOICE)
    {
        snprintf(word, sizeof word, "--%s=-1e9x", option->name);
        ck_assert_int_eq(parse(command, word, NULL, message), CM_OPTIONS_WRONG);
        ck_assert_msg(strstr(message, "is '-1e9x', not") != NULL, "%s", message);
    }
}

/* With a letter too many. */
static void check_misspelt(const cm_command *command, const cm_option *option)
{
    char word[100];
    char wanted[100];
    char message[CM_OPTIONS_MESSAGE];
    const size_t length = strlen(option->name);
    snprintf(word, sizeof word, "--%sx", option->name);
    word[length + 2] = 'z';
    snprintf(wanted, sizeof wanted, "did you mean --%s?", option->name);
    ck_assert_int_eq(parse(command, word, NULL, message), CM_OPTIONS_WRONG);
    ck_assert_msg(length < 2 || strstr(message, wanted) != NULL, "%s: %s", word, message);
}

/* Calls for every option of every command of every program. */
static void for_every_option(void (*check)(const cm_command *, const cm_option *))
{
    size_t count = 0;
    for (size_t p = 0; p < PROGRAMS; p++)
    {
        const cm_command *command;
        for (size_t c = 0; (command = command_at(p, c)) != NULL; c++)
        {
            const cm_option *option;
            /* --help and --version, the last two, print */
            for (size_t i = 0; (option = cm_options_at(command, i)) != NULL; i++)
            {
                if (strcmp(option->name, "help") != 0 && strcmp(option->name, "version") != 0)
                {
                    check(command, option);
                    count++;
                }
            }
        }
    }
    ck_assert_uint_ge(count, 45);
}

START_TEST(options_are_parsed)
{
    for_every_option(check_option);
}
END_TEST

START_TEST(nearest_options)
{
    for_every_option(check_misspelt);
}
END_TEST

/* Every option has a text that ends without a full stop, and an argument to show if it takes one. */
static void check_text(const cm_command *command, const cm_option *option)
{
    const size_t length = strlen(option->help);
    (void)command;
    ck_assert_msg(length > 0 && option->help[length - 1] != '.', "%s", option->name);
    ck_assert_msg((option->kind == CM_OPTION_NONE) == (option->argument == NULL), "%s",
                  option->name);
    ck_assert_msg(option->more == NULL || option->more[strlen(option->more) - 1] == '.', "%s",
                  option->name);
    if (option->kind == CM_OPTION_NUMBER || option->kind == CM_OPTION_WHOLE)
    {
        ck_assert_msg(option->low < option->high, "%s", option->name);
    }
    if (option->kind == CM_OPTION_CHOICE)
    {
        ck_assert_msg(cm_option_choice_at(option, 1) != NULL, "%s", option->name);
    }
}

START_TEST(texts)
{
    for_every_option(check_text);
}
END_TEST

/* Does a text have the option's name, between dashes and what is no letter? */
static int tells(const char *text, const char *before, const char *name)
{
    char word[256];
    snprintf(word, sizeof word, "%s%s", before, name);
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word))
    {
        const char after = at[strlen(word)];
        if (!(after >= 'a' && after <= 'z') && after != '-')
        {
            return 1;
        }
    }
    return 0;
}

/* The name as roff has it. */
static const char *escaped(const char *name)
{
    static char text[200];
    size_t length = 0;
    for (; *name != '\0' && length + 3 < sizeof text; name++)
    {
        if (*name == '-')
        {
            text[length++] = '\\';
        }
        text[length++] = *name;
    }
    text[length] = '\0';
    return text;
}

static void check_words_of(size_t program, const cm_command *command)
{
    talk help = ask(program, command, "--help", NULL);
    talk manual = ask(program, command, "--man", NULL);
    talk shell[3] = {ask(program, command, "--completion", "bash"),
                     ask(program, command, "--completion", "zsh"),
                     ask(program, command, "--completion", "fish")};
    const cm_option *option;
    ck_assert_msg(help.status == 0 && *help.messages == '\0', "%s", help.messages);
    ck_assert_int_eq(strncmp(help.output, "Usage: cubemap-", 15), 0);
    for (size_t i = 0; (option = cm_options_at(command, i)) != NULL; i++)
    {
        ck_assert_msg(tells(help.output, "--", option->name), "--help and %s", option->name);
        ck_assert_msg(tells(manual.output, "\\-\\-", escaped(option->name)), "the man page and %s",
                      option->name);
        ck_assert_msg(tells(shell[0].output, "--", option->name), "bash and %s", option->name);
        ck_assert_msg(tells(shell[1].output, "--", option->name), "zsh and %s", option->name);
        ck_assert_msg(tells(shell[2].output, " -l ", option->name), "fish and %s", option->name);
    }
    /* no line is wider than a terminal */
    for (const char *line = help.output; *line != '\0'; line += strcspn(line, "\n") + 1)
    {
        ck_assert_msg(strcspn(line, "\n") <= 80, "%.100s", line);
    }
    drop(&help);
    drop(&manual);
    for (int i = 0; i < 3; i++)
    {
        drop(&shell[i]);
    }
}

START_TEST(every_text_tells_every_option)
{
    for (size_t p = 0; p < PROGRAMS; p++)
    {
        const cm_command *command;
        for (size_t c = 0; (command = command_at(p, c)) != NULL; c++)
        {
            check_words_of(p, command);
        }
    }
}
END_TEST

/* status, and what a message ends with */
static void check_call(size_t program, const char *const *words, int status, const char *end)
{
    talk with = call(programs[program].call, words, "12.5 41.9 Rome\n");
    const size_t length = strlen(with.messages);
    const size_t wanted = strlen(end);
    ck_assert_msg(with.status == status, "%s %s: status %d: %s", words[0], words[1], with.status,
                  with.messages);
    ck_assert_msg(length >= wanted && strcmp(with.messages + length - wanted, end) == 0, "%s",
                  with.messages);
    ck_assert_msg(status != 2 || *with.output == '\0', "%s", with.output);
    drop(&with);
}

START_TEST(nearest_names)
{
    static const struct
    {
        size_t program;
        const char *words[4];
        const char *end;
    } rows[] = {{0, {"x", "-m", "tangnt", NULL}, "did you mean tangent?\n"},
                {0, {"x", "-m", "tangnt:c=1", NULL}, "did you mean tangent?\n"},
                {0, {"x", "-m", "azimuthal:lambrt", NULL}, "did you mean azimuthal:lambert?\n"},
                {0, {"x", "-m", "piers", NULL}, "see --list\n"},
                {0, {"x", "-m", "pierce", NULL}, "did you mean peirce?\n"},
                {0, {"x", "--frame", "goe", NULL}, "did you mean geo?\n"},
                {0, {"x", "--ellipsoid", "WGS48", NULL}, "did you mean WGS84?\n"},
                {0, {"x", "--latitude=autalic", NULL}, "did you mean authalic?\n"},
                {0, {"x", "--rotate=land-edge", NULL}, "did you mean land-edges?\n"},
                {0, {"x", "--input=xy", NULL}, "did you mean xyz?\n"},
                {1, {"x", "--to=confromal", NULL}, "did you mean conformal?\n"},
                {1, {"x", "--to=authalic", "--ellipsoid=Mrs", NULL}, "did you mean Mars?\n"},
                {2, {"x", "tangnt", NULL}, "did you mean tangent?\n"},
                {2, {"x", "advice", NULL}, "did you mean advise?\n"},
                {2, {"x", "papers", "grd", NULL}, "did you mean grid?\n"},
                {2, {"x", "advise", "--precision=fats", NULL}, "did you mean fast?\n"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    {
        check_call(rows[i].program, rows[i].words, 2, rows[i].end);
    }
}
END_TEST

/* A thousand calls, good and bad: nothing is left from one to the next. */
START_TEST(many_calls)
{
    static const char *const project[] = {"x", "--digits", "6", "-m", "gnomonic", NULL};
    static const char *const latitude[] = {"x", "--to", "authalic", "--digits", "12", NULL};
    static const char *const bench[] = {"x", "--list", "t*", NULL};
    static const char *const wrong[] = {"x", "-m", "qsc", "--cell", "77", NULL};
    for (int i = 0; i < 1000; i += (int)step_of(50))
    {
        talk with = call(cm_project_main, project, "12.5 41.9 Rome\n# end\n");
        ck_assert_int_eq(with.status, 0);
        ck_assert_str_eq(with.output, "0 0.221695 0.919033 Rome\n# end\n");
        drop(&with);
        with = call(cm_latitude_main, latitude, "41.9 Rome");
        ck_assert_int_eq(with.status, 0);
        ck_assert_str_eq(with.output, "41.772479498 Rome\n");
        drop(&with);
        with = call(cm_latitude_main, latitude, "x\n1");
        ck_assert_int_eq(with.status, 1);
        ck_assert_str_eq(with.messages, "<stdin>:1: 'x' is not a number: a line is a LATITUDE in "
                                        "degrees\n");
        drop(&with);
        with = call(cm_bench_main, bench, "");
        ck_assert_int_eq(with.status, 0);
        ck_assert_str_eq(with.output, "tangent\ntanh\n");
        drop(&with);
        check_call(0, wrong, 2, "it begins with a whole number from 0 to 30\n");
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        options_are_parsed, nearest_options, texts, every_text_tells_every_option,
        nearest_names,      many_calls,      NULL};
    return run_suite("program options", tests);
}
