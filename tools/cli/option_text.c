/* SPDX-License-Identifier: MIT */
#include "option_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <string.h>

#include <cubemap/number.h>

enum
{
    WIDTH = 80,
    COLUMN_MAX = 28 /* where texts begin at the latest */
};

const char *option_choice(const char *const *choices, const char *(*choice_at)(size_t),
                          size_t index)
{
    if (choices == NULL)
    {
        return choice_at == NULL ? NULL : choice_at(index);
    }
    for (size_t i = 0; i < index; i++)
    {
        if (choices[i] == NULL)
        {
            return NULL;
        }
    }
    return choices[index];
}

size_t option_count(const cm_command *command)
{
    size_t count = 0;
    for (size_t i = 0; i < command->group_count; i++)
    {
        count += command->groups[i].count;
    }
    return count;
}

/* ------------------------------------------------------------------------------- phrases */

static void append(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
}

void option_range(const cm_option *option, char text[OPTION_RANGE_MAX])
{
    char low[CM_NUMBER_SIZE];
    char high[CM_NUMBER_SIZE];
    const bool above = (option->flags & CM_OPTION_ABOVE) != 0;
    cm_number_write_shortest(option->low, low);
    cm_number_write_shortest(option->high, high);
    text[0] = '\0';
    append(text, OPTION_RANGE_MAX, option->kind == CM_OPTION_WHOLE ? "a whole number" : "a number");
    if (isinf(option->high))
    {
        append(text, OPTION_RANGE_MAX, above ? " above %s" : " of %s or more", low);
    }
    else
    {
        append(text, OPTION_RANGE_MAX, above ? " above %s, to %s" : " from %s to %s", low, high);
    }
}

void option_choices(const char *const *choices, const char *(*choice_at)(size_t),
                    char text[OPTION_TEXT_MAX])
{
    size_t count = 0;
    while (option_choice(choices, choice_at, count) != NULL)
    {
        count++;
    }
    text[0] = '\0';
    append(text, OPTION_TEXT_MAX, "%s", count > 3 ? "one of " : "");
    const char *choice;
    for (size_t i = 0; (choice = option_choice(choices, choice_at, i)) != NULL; i++)
    {
        const char *const before = i == 0 ? "" : i + 1 < count || count > 3 ? ", " : " or ";
        append(text, OPTION_TEXT_MAX, "%s%s", before, choice);
    }
}

/* ", 1 to 17": of a limit that is no more than a sign nothing is said. */
static void append_range(const cm_option *option, char text[OPTION_TEXT_MAX])
{
    char low[CM_NUMBER_SIZE];
    char high[CM_NUMBER_SIZE];
    cm_number_write_shortest(option->low, low);
    cm_number_write_shortest(option->high, high);
    if (!isinf(option->high))
    {
        append(text, OPTION_TEXT_MAX, ", %s to %s", low, high);
    }
    else if (option->low > 0.0)
    {
        append(text, OPTION_TEXT_MAX, ", %s or more", low);
    }
}

/* ": geo, gl or s2" */
static void append_choices(const cm_option *option, char text[OPTION_TEXT_MAX])
{
    const char *choice;
    for (size_t i = 0; (choice = cm_option_choice_at(option, i)) != NULL; i++)
    {
        const bool last = i > 0 && cm_option_choice_at(option, i + 1) == NULL;
        append(text, OPTION_TEXT_MAX, "%s`%s`", i == 0 ? ": " : last ? " or " : ", ", choice);
    }
}

void option_help(const cm_option *option, int with_default, char text[OPTION_TEXT_MAX])
{
    const bool told = (option->flags & CM_OPTION_TOLD) != 0;
    text[0] = '\0';
    append(text, OPTION_TEXT_MAX, "%s", option->help);
    if (!told && (option->kind == CM_OPTION_NUMBER || option->kind == CM_OPTION_WHOLE))
    {
        append_range(option, text);
    }
    else if (!told && option->kind == CM_OPTION_CHOICE)
    {
        append_choices(option, text);
    }
    if (with_default && option->standard != NULL)
    {
        append(text, OPTION_TEXT_MAX, "; default: %s", option->standard);
    }
}

void option_summary(const cm_option *option, char text[OPTION_TEXT_MAX])
{
    size_t length = 0;
    for (const char *at = option->help; *at != '\0'; at++)
    {
        if (strncmp(at, " (", 2) == 0 || strncmp(at, "; ", 2) == 0 || strncmp(at, ": ", 2) == 0)
        {
            break;
        }
        if (*at != '`' && length + 1 < OPTION_TEXT_MAX)
        {
            text[length++] = *at;
        }
    }
    text[length] = '\0';
}

/* ------------------------------------------------------------------------------- paragraphs */

const char *next_paragraph(const char **text, size_t *length)
{
    const char *const start = *text + strspn(*text, "\n");
    const char *end = start + strcspn(start, "\n");
    /* lines that follow each other are one, but for those that begin with a blank */
    while (*start != ' ' && end[0] == '\n' && end[1] != '\n' && end[1] != ' ' && end[1] != '\0')
    {
        end += 1 + strcspn(end + 1, "\n");
    }
    *length = (size_t)(end - start);
    *text = *end == '\0' ? end : end + 1;
    return *start == '\0' ? NULL : start;
}

static bool is_break(char character)
{
    return character == ' ' || character == '\n';
}

/* Without the marks. */
static size_t shown_length(const char *text, size_t length)
{
    size_t shown = 0;
    for (size_t i = 0; i < length; i++)
    {
        shown += text[i] != '`';
    }
    return shown;
}

static void write_shown(FILE *stream, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
    {
        if (text[i] != '`')
        {
            putc(text[i], stream);
        }
    }
}

void write_filled(FILE *stream, const char *text, size_t length, size_t indent, size_t at,
                  size_t width)
{
    const char *const end = text + length;
    const char *before = "";
    while (text < end)
    {
        const char *stop = text;
        while (stop < end && !is_break(*stop))
        {
            stop++;
        }
        const size_t shown = shown_length(text, (size_t)(stop - text));
        if (*before != '\0' && at + 1 + shown > width)
        {
            fprintf(stream, "\n%*s", (int)indent, "");
            at = indent;
            before = "";
        }
        fputs(before, stream);
        write_shown(stream, text, (size_t)(stop - text));
        at += strlen(before) + shown;
        before = " ";
        text = stop + (stop < end);
    }
    putc('\n', stream);
}

static void write_paragraphs(FILE *stream, const char *text)
{
    const char *before = text;
    size_t length;
    for (const char *at; (at = next_paragraph(&text, &length)) != NULL; before = at + length)
    {
        /* blank lines stay */
        if (at > before + 1)
        {
            putc('\n', stream);
        }
        if (*at == ' ')
        {
            write_shown(stream, at, length);
            putc('\n', stream);
        }
        else
        {
            write_filled(stream, at, length, 0, 0, WIDTH);
        }
    }
}

/* ------------------------------------------------------------------------------- --help */

/* "  -m, --mapping MAPPING" */
static size_t write_head(const cm_option *option, char text[OPTION_TEXT_MAX])
{
    const bool optional = (option->flags & CM_OPTION_OPTIONAL) != 0;
    text[0] = '\0';
    if (option->letter != '\0')
    {
        append(text, OPTION_TEXT_MAX, "  -%c, --%s", option->letter, option->name);
    }
    else
    {
        append(text, OPTION_TEXT_MAX, "      --%s", option->name);
    }
    if (option->kind != CM_OPTION_NONE)
    {
        append(text, OPTION_TEXT_MAX, optional ? "[=%s]" : " %s", option->argument);
    }
    return strlen(text);
}

/* Where the texts begin: behind most of the heads. */
static size_t find_column(const cm_command *command)
{
    char head[OPTION_TEXT_MAX];
    size_t column = 0;
    const cm_option *option;
    for (size_t i = 0; (option = cm_options_at(command, i)) != NULL; i++)
    {
        const size_t length = write_head(option, head) + 2;
        if ((option->flags & CM_OPTION_HIDDEN) == 0 && length > column && length <= COLUMN_MAX)
        {
            column = length;
        }
    }
    return column;
}

static void write_entry(FILE *stream, const cm_option *option, size_t column)
{
    char text[OPTION_TEXT_MAX];
    if ((option->flags & CM_OPTION_HIDDEN) != 0)
    {
        return;
    }
    const size_t length = write_head(option, text);
    if (length + 2 <= column)
    {
        fprintf(stream, "%-*s", (int)column, text);
    }
    else
    {
        fprintf(stream, "%s\n%*s", text, (int)column, "");
    }
    option_help(option, 1, text);
    write_filled(stream, text, strlen(text), column, column, WIDTH);
}

static void write_usage(FILE *stream, const cm_command *command)
{
    const char *line = command->usage;
    for (const char *before = "Usage:"; *line != '\0'; before = "      ")
    {
        const size_t length = strcspn(line, "\n");
        fprintf(stream, "%s %s%s%.*s\n", before, command->name, length > 0 ? " " : "", (int)length,
                line);
        line += length + (line[length] == '\n');
    }
}

static void write_groups(FILE *stream, const cm_command *command, size_t column)
{
    const cm_option *option;
    size_t index = 0;
    for (size_t g = 0; g < command->group_count; g++)
    {
        const cm_option_group *const group = &command->groups[g];
        putc('\n', stream);
        if (group->heading != NULL)
        {
            fprintf(stream, "%s:\n", group->heading);
        }
        for (size_t i = 0; i < group->count; i++, index++)
        {
            write_entry(stream, &group->options[i], column);
        }
        /* what every command has ends the first group */
        for (size_t own = option_count(command);
             g == 0 && (option = cm_options_at(command, own)) != NULL; own++)
        {
            write_entry(stream, option, column);
        }
    }
}

void cm_options_write_help(FILE *stream, const cm_command *command)
{
    write_usage(stream, command);
    putc('\n', stream);
    write_paragraphs(stream, command->summary);
    write_groups(stream, command, find_column(command));
    if (command->notes != NULL)
    {
        putc('\n', stream);
        write_paragraphs(stream, command->notes);
    }
}
