/* SPDX-License-Identifier: MIT
 *
 * The options of a man page, in the language of roff.
 */
#include "option_text.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

static bool is_letter(char character)
{
    return isalnum((unsigned char)character) != 0 || character == '_';
}

static void write_escaped(FILE *stream, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
    {
        if (text[i] == '\\')
        {
            fputs("\\e", stream);
        }
        else
        {
            fputs(text[i] == '-' ? "\\" : "", stream);
            putc(text[i], stream);
        }
    }
}

static void write_in(FILE *stream, const char *font, const char *text, size_t length)
{
    fprintf(stream, "\\f%s", font);
    write_escaped(stream, text, length);
    fputs("\\fR", stream);
}

/* Does this word stand for something, among all the words of the other text? */
static bool stands_in(const char *text, const char *word, size_t length)
{
    for (const char *at = text; at != NULL && *at != '\0';)
    {
        size_t size = 0;
        while (is_letter(at[size]))
        {
            size++;
        }
        if (size == length && strncmp(at, word, length) == 0)
        {
            return true;
        }
        at += size + (at[size] != '\0');
    }
    return false;
}

static bool is_capital(const char *word, size_t length)
{
    bool capital = false;
    for (size_t i = 0; i < length; i++)
    {
        if (word[i] >= 'a' && word[i] <= 'z')
        {
            return false;
        }
        capital = capital || (word[i] >= 'A' && word[i] <= 'Z');
    }
    return capital;
}

/* The length of -L or --NAME at text, if an option is written there. */
static size_t option_length(const char *text)
{
    size_t length = text[0] == '-' ? (text[1] == '-' ? 2 : 1) : 0;
    const size_t dashes = length;
    if (dashes == 0 || !isalpha((unsigned char)text[dashes]))
    {
        return 0;
    }
    while (is_letter(text[length]) || (dashes == 2 && text[length] == '-'))
    {
        length++;
    }
    return dashes == 1 && length > 2 ? 0 : length;
}

/* A word at its beginning, or one character; returns how much was written. */
static size_t write_piece(FILE *stream, const cm_command *command, const cm_option *option,
                          const char *text, bool begins)
{
    size_t length = begins ? option_length(text) : 0;
    if (length > 0)
    {
        write_in(stream, "B", text, length);
        return length;
    }
    while (is_letter(text[length]))
    {
        length++;
    }
    if (length == 0)
    {
        write_escaped(stream, text, 1);
        return 1;
    }
    if (begins && is_capital(text, length) &&
        (stands_in(option->argument, text, length) || stands_in(command->usage, text, length) ||
         stands_in(command->words, text, length)))
    {
        write_in(stream, "I", text, length);
    }
    else
    {
        write_escaped(stream, text, length);
    }
    return length;
}

/* Each sentence begins a line. */
static void write_sentences(FILE *stream, const cm_command *command, const cm_option *option,
                            const char *text)
{
    bool begins = true;
    while (*text != '\0')
    {
        if (*text == '`')
        {
            const size_t length = strcspn(text + 1, "`");
            write_in(stream, "B", text + 1, length);
            text += length + 1 + (text[length + 1] == '`');
            begins = false;
        }
        else if (text[0] == '.' && text[1] == ' ')
        {
            fputs(".\n", stream);
            text += 2;
            begins = true;
        }
        else
        {
            const size_t length = write_piece(stream, command, option, text, begins);
            begins = !is_letter(text[length - 1]) && text[length - 1] != '-';
            text += length;
        }
    }
    putc('\n', stream);
}

/* MAPPING slanted, yes|no bold, what stands between them as it is. */
static void write_argument(FILE *stream, const char *text)
{
    while (*text != '\0')
    {
        size_t length = 0;
        while (is_letter(text[length]))
        {
            length++;
        }
        if (length > 0)
        {
            write_in(stream, is_capital(text, length) ? "I" : "B", text, length);
        }
        else
        {
            write_escaped(stream, text, ++length);
        }
        text += length;
    }
}

static void write_head(FILE *stream, const cm_option *option)
{
    const bool optional = (option->flags & CM_OPTION_OPTIONAL) != 0;
    fputs(".TP\n", stream);
    if (option->letter != '\0')
    {
        const char letter[2] = {'-', option->letter};
        write_in(stream, "B", letter, 2);
        fputs(", ", stream);
    }
    fputs("\\fB\\-\\-", stream);
    write_escaped(stream, option->name, strlen(option->name));
    fputs("\\fR", stream);
    if (option->kind != CM_OPTION_NONE)
    {
        fputs(optional ? "[=" : " ", stream);
        write_argument(stream, option->argument);
        fputs(optional ? "]" : "", stream);
    }
    putc('\n', stream);
}

/* A phrase as a sentence: with a capital and a full stop. */
static void make_sentence(char text[OPTION_TEXT_MAX])
{
    const size_t length = strlen(text);
    text[0] = (char)toupper((unsigned char)text[0]);
    if (length > 0 && text[length - 1] != '.' && length + 1 < OPTION_TEXT_MAX)
    {
        memcpy(text + length, ".", 2);
    }
}

static void write_entry(FILE *stream, const cm_command *command, const cm_option *option)
{
    char text[OPTION_TEXT_MAX];
    write_head(stream, option);
    option_help(option, 0, text);
    make_sentence(text);
    write_sentences(stream, command, option, text);
    if (option->more != NULL)
    {
        write_sentences(stream, command, option, option->more);
    }
    if (option->standard != NULL)
    {
        snprintf(text, sizeof text, "Default: %s.", option->standard);
        write_sentences(stream, command, option, text);
    }
}

void cm_options_write_manual(FILE *stream, const cm_command *command)
{
    const cm_option *option;
    size_t heading_at = 0;
    size_t group = 0;
    for (size_t i = 0; (option = cm_options_at(command, i)) != NULL; i++)
    {
        for (; group < command->group_count && i == heading_at; group++)
        {
            if (command->groups[group].heading != NULL)
            {
                fprintf(stream, ".SS %s\n", command->groups[group].heading);
            }
            heading_at += command->groups[group].count;
        }
        if ((option->flags & CM_OPTION_HIDDEN) == 0)
        {
            write_entry(stream, command, option);
        }
    }
}
