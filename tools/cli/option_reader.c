/* SPDX-License-Identifier: MIT
 *
 * Parsing, as getopt_long does it: --name=value, --name value, abbreviations that are of one option, letters in
 * bundles, -- and operands anywhere.
 */
#include "option_table.h"

#include <cubemap/version.h>

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <string.h>

#include "nearest.h"
#include "number_word.h"
#include "option_text.h"

/* ------------------------------------------------------------------------------- the table */

enum
{
    ID_HELP = 1 << 20,
    ID_VERSION,
    ID_COMPLETION,
    ID_MANUAL
};

static const char *const shells[] = {"bash", "zsh", "fish", NULL};

/* What every command has; what is listed of it comes first. */
static const cm_option common[] = {
    {.id = ID_HELP, .letter = 'h', .name = "help", .help = "print this help"},
    {.id = ID_VERSION, .name = "version", .help = "print the version"},
    {.id = ID_COMPLETION,
     .name = "completion",
     .kind = CM_OPTION_CHOICE,
     .argument = "SHELL",
     .help = "print what completes the command in a shell",
     .choices = shells,
     .flags = CM_OPTION_HIDDEN},
    {.id = ID_MANUAL,
     .name = "man",
     .help = "print the options for the man page",
     .flags = CM_OPTION_HIDDEN},
};

enum
{
    COMMON_COUNT = sizeof common / sizeof *common
};

const cm_option *cm_options_at(const cm_command *command, size_t index)
{
    for (size_t i = 0; i < command->group_count; i++)
    {
        if (index < command->groups[i].count)
        {
            return &command->groups[i].options[index];
        }
        index -= command->groups[i].count;
    }
    for (size_t i = 0; i < COMMON_COUNT; i++)
    {
        if ((common[i].flags & CM_OPTION_HIDDEN) == 0 && index-- == 0)
        {
            return &common[i];
        }
    }
    return NULL;
}

/* The same with those that are not listed. */
static const cm_option *any_option_at(const cm_command *command, size_t index)
{
    const size_t own = option_count(command);
    if (index < own)
    {
        return cm_options_at(command, index);
    }
    return index - own < COMMON_COUNT ? &common[index - own] : NULL;
}

const char *cm_option_choice_at(const cm_option *option, size_t index)
{
    return option_choice(option->choices, option->choice_at, index);
}

/* ------------------------------------------------------------------------------- messages */

/* The message is one line, whatever was typed. */
static int refuse(cm_option_reader *reader, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static int refuse(cm_option_reader *reader, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reader->message, sizeof reader->message, format, arguments);
    va_end(arguments);
    for (char *at = reader->message; *at != '\0'; at++)
    {
        if ((unsigned char)*at < ' ' || *at == 0x7f)
        {
            *at = '?';
        }
    }
    return CM_OPTIONS_WRONG;
}

int cm_options_refuse(cm_option_reader *reader, const char *what)
{
    return refuse(reader, "--%s is '%s', not %s", reader->option->name, reader->text, what);
}

/* The program's name, without a command. */
static int program_length(const cm_command *command)
{
    return (int)strcspn(command->name, " ");
}

static void add_to_message(cm_option_reader *reader, const char *before, const char *name)
{
    const size_t used = strlen(reader->message);
    snprintf(reader->message + used, sizeof reader->message - used, "%s--%s", before, name);
}

/* There are several options that begin so. */
static int refuse_short_name(cm_option_reader *reader, const char *name, size_t length)
{
    const char *before = ": ";
    const cm_option *option;
    refuse(reader, "--%.*s is short for several options", (int)length, name);
    for (size_t i = 0; (option = cm_options_at(reader->command, i)) != NULL; i++)
    {
        if ((option->flags & CM_OPTION_HIDDEN) == 0 && strncmp(option->name, name, length) == 0)
        {
            add_to_message(reader, before, option->name);
            before = ", ";
        }
    }
    return CM_OPTIONS_WRONG;
}

static int refuse_name(cm_option_reader *reader, const char *name, size_t length)
{
    cm_nearest nearest = cm_nearest_to(name, length);
    const cm_option *option;
    const int shown = length < 200 ? (int)length : 200;
    for (size_t i = 0; (option = cm_options_at(reader->command, i)) != NULL; i++)
    {
        if ((option->flags & CM_OPTION_HIDDEN) == 0)
        {
            cm_nearest_try(&nearest, option->name, strlen(option->name));
        }
    }
    if (nearest.best != NULL)
    {
        return refuse(reader, "there is no option --%.*s; did you mean --%s?", shown, name,
                      nearest.best);
    }
    return refuse(reader, "there is no option --%.*s; see %s --help", shown, name,
                  reader->command->name);
}

/* ------------------------------------------------------------------------------- arguments */

static int take_number(cm_option_reader *reader)
{
    const cm_option *const option = reader->option;
    const char *const end = reader->text + strlen(reader->text);
    const bool whole = option->kind == CM_OPTION_WHOLE;
    double value = (double)NAN;
    char range[OPTION_RANGE_MAX];
    if (number_or_word(reader->text, end, &value) != end)
    {
        value = (double)NAN;
    }
    if (!(value >= option->low && value <= option->high) || (whole && value != floor(value)) ||
        ((option->flags & CM_OPTION_ABOVE) != 0 && value == option->low))
    {
        option_range(option, range);
        return cm_options_refuse(reader, range);
    }
    reader->number = value;
    return option->id;
}

static int take_choice(cm_option_reader *reader)
{
    char known[OPTION_TEXT_MAX];
    cm_nearest nearest = cm_nearest_to(reader->text, strlen(reader->text));
    const char *choice;
    for (size_t i = 0; (choice = cm_option_choice_at(reader->option, i)) != NULL; i++)
    {
        if (strcmp(choice, reader->text) == 0)
        {
            reader->choice = i;
            return reader->option->id;
        }
        cm_nearest_try(&nearest, choice, strlen(choice));
    }
    option_choices(reader->option->choices, reader->option->choice_at, known);
    cm_options_refuse(reader, known);
    cm_nearest_append(&nearest, reader->message, sizeof reader->message);
    return CM_OPTIONS_WRONG;
}

/* What the options that every command has print. */
static int print_common(cm_option_reader *reader)
{
    FILE *const out = reader->streams->out;
    switch (reader->option->id)
    {
    case ID_HELP:
        cm_options_write_help(out, reader->command);
        break;
    case ID_VERSION:
        fprintf(out, "%.*s%s %s\n", program_length(reader->command), reader->command->name,
                reader->command->bare_version != 0 ? "" : " (libcubemap)", cm_version());
        break;
    case ID_COMPLETION:
        cm_options_write_completion(out, reader->command, reader->text);
        break;
    default:
        cm_options_write_manual(out, reader->command);
        break;
    }
    return CM_OPTIONS_PRINTED;
}

static int take_argument(cm_option_reader *reader)
{
    int result = reader->option->id;
    if (reader->text != NULL)
    {
        switch (reader->option->kind)
        {
        case CM_OPTION_NUMBER:
        case CM_OPTION_WHOLE:
            result = take_number(reader);
            break;
        case CM_OPTION_CHOICE:
            result = take_choice(reader);
            break;
        default:
            break;
        }
    }
    return result >= ID_HELP ? print_common(reader) : result;
}

/* ------------------------------------------------------------------------------- the command line */

cm_option_reader cm_options_begin(const cm_command *command, int argc, char **argv,
                                  const cm_streams *streams)
{
    const cm_option_reader reader = {.command = command,
                                     .streams = streams,
                                     .argc = argc,
                                     .argv = argv,
                                     .position = 1,
                                     .first_operand = 1};
    return reader;
}

/* Moves the words before the position, so many, before the operands that they follow. */
static void move_behind_operands(cm_option_reader *reader, int count)
{
    char **const operands = reader->argv + reader->first_operand;
    const int operand_count = reader->position - count - reader->first_operand;
    for (int i = 0; i < count && operand_count > 0; i++)
    {
        char *const word = operands[operand_count + i];
        memmove(operands + i + 1, operands + i, (size_t)operand_count * sizeof *operands);
        operands[i] = word;
    }
    reader->first_operand += count;
}

static int needs_no_more(const cm_option *option)
{
    return option->kind == CM_OPTION_NONE || (option->flags & CM_OPTION_OPTIONAL) != 0;
}

/* The word at the position is the option; its argument is attached, or the word behind. */
static int take_option(cm_option_reader *reader, const char *attached)
{
    const cm_option *const option = reader->option;
    int words = 1;
    reader->text = attached;
    reader->position++;
    if (attached != NULL && option->kind == CM_OPTION_NONE)
    {
        return refuse(reader, "--%s takes no argument; see %s --help", option->name,
                      reader->command->name);
    }
    if (attached == NULL && !needs_no_more(option))
    {
        if (reader->position >= reader->argc)
        {
            return refuse(reader, "--%s needs an argument; see %s --help", option->name,
                          reader->command->name);
        }
        reader->text = reader->argv[reader->position++];
        words = 2;
    }
    move_behind_operands(reader, words);
    return take_argument(reader);
}

static int take_long_option(cm_option_reader *reader, const char *name)
{
    const char *const equals = strchr(name, '=');
    const size_t length = equals != NULL ? (size_t)(equals - name) : strlen(name);
    const cm_option *option;
    int found = 0;
    for (size_t i = 0; (option = any_option_at(reader->command, i)) != NULL; i++)
    {
        if (strlen(option->name) == length && strncmp(option->name, name, length) == 0)
        {
            reader->option = option;
            found = 1;
            break;
        }
        if ((option->flags & CM_OPTION_HIDDEN) == 0 && strncmp(option->name, name, length) == 0)
        {
            reader->option = option;
            found++;
        }
    }
    if (found > 1 && length > 0)
    {
        return refuse_short_name(reader, name, length);
    }
    if (found != 1 || length == 0)
    {
        return refuse_name(reader, name, length);
    }
    return take_option(reader, equals != NULL ? equals + 1 : NULL);
}

/* The next letter of the bundle. */
static int take_letter(cm_option_reader *reader)
{
    const char letter = *reader->bundle++;
    const char *const rest = *reader->bundle == '\0' ? NULL : reader->bundle;
    const cm_option *option = NULL;
    for (size_t i = 0; (option = any_option_at(reader->command, i)) != NULL; i++)
    {
        if (option->letter == letter)
        {
            break;
        }
    }
    if (option == NULL)
    {
        return refuse(reader, "there is no option -%c; see %s --help", letter,
                      reader->command->name);
    }
    reader->option = option;
    if (option->kind == CM_OPTION_NONE && rest != NULL)
    {
        reader->text = NULL;
        return take_argument(reader);
    }
    reader->bundle = NULL;
    return take_option(reader, rest);
}

static int finish(cm_option_reader *reader)
{
    reader->position = reader->argc;
    reader->operands = reader->argv + reader->first_operand;
    reader->operand_count =
        reader->argc > reader->first_operand ? reader->argc - reader->first_operand : 0;
    return CM_OPTIONS_END;
}

int cm_options_next(cm_option_reader *reader)
{
    if (reader->bundle != NULL)
    {
        return take_letter(reader);
    }
    for (; reader->position < reader->argc; reader->position++)
    {
        const char *const word = reader->argv[reader->position];
        if (strcmp(word, "--") == 0)
        {
            reader->position++;
            move_behind_operands(reader, 1);
            break;
        }
        if (word[0] == '-' && word[1] == '-')
        {
            return take_long_option(reader, word + 2);
        }
        if (word[0] == '-' && word[1] != '\0')
        {
            reader->bundle = word + 1;
            return take_letter(reader);
        }
    }
    return finish(reader);
}
