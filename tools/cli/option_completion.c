/* SPDX-License-Identifier: MIT
 *
 * Completion scripts for shells. A program with commands has one script, which looks at the first word.
 */
#include "option_text.h"

#include <stdbool.h>
#include <string.h>

/* ------------------------------------------------------------------------------- what shells share */

/* The program's name with _ for what no name of a function has. */
static void write_function_name(FILE *stream, const char *name)
{
    putc('_', stream);
    for (; *name != '\0'; name++)
    {
        putc(*name == '-' || *name == ' ' ? '_' : *name, stream);
    }
}

static bool is_listed(const cm_option *option)
{
    return (option->flags & CM_OPTION_HIDDEN) == 0;
}

static bool has_choices(const cm_option *option)
{
    return cm_option_choice_at(option, 0) != NULL;
}

/* Between quotation marks of a shell; marks before each of some characters. */
static void write_quoted(FILE *stream, const char *text, const char *marked)
{
    for (; *text != '\0'; text++)
    {
        if (*text == '\'')
        {
            fputs("'\\''", stream);
        }
        else
        {
            fputs(strchr(marked, *text) != NULL ? "\\" : "", stream);
            putc(*text, stream);
        }
    }
}

static void write_words(FILE *stream, const cm_option *option, const char *marked)
{
    const char *choice;
    for (size_t i = 0; (choice = cm_option_choice_at(option, i)) != NULL; i++)
    {
        fputs(i == 0 ? "" : " ", stream);
        write_quoted(stream, choice, marked);
    }
}

/* The operands as if they were an option's argument. */
static cm_option operand_of(const cm_command *command)
{
    const cm_option operand = {
        .kind = command->operand, .choices = command->choices, .choice_at = command->choice_at};
    return operand;
}

static const char *last_word(const char *name)
{
    const char *const blank = strrchr(name, ' ');
    return blank != NULL ? blank + 1 : name;
}

/* ------------------------------------------------------------------------------- bash */

/* What completes the word behind an option, or an operand. */
static void write_bash_reply(FILE *stream, const cm_option *option)
{
    if (option->kind == CM_OPTION_FILE)
    {
        fputs("compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$word\")", stream);
    }
    else if (has_choices(option))
    {
        fputs("mapfile -t COMPREPLY < <(compgen -W '", stream);
        write_words(stream, option, "");
        fputs("' -- \"$word\")", stream);
    }
    else
    {
        fputs(":", stream);
    }
}

static void write_bash_case(FILE *stream, const cm_option *option)
{
    if (option->kind == CM_OPTION_NONE || !is_listed(option))
    {
        return;
    }
    fprintf(stream, "        =--%s", option->name);
    if ((option->flags & CM_OPTION_OPTIONAL) == 0)
    {
        fprintf(stream, " | --%s", option->name);
        if (option->letter != '\0')
        {
            fprintf(stream, " | -%c", option->letter);
        }
    }
    fputs(") ", stream);
    write_bash_reply(stream, option);
    fputs(" ;;\n", stream);
}

static void write_bash_names(FILE *stream, const cm_command *command)
{
    const cm_option *option;
    const char *before = "";
    for (size_t i = 0; (option = cm_options_at(command, i)) != NULL; i++)
    {
        if (is_listed(option))
        {
            fprintf(stream, "%s--%s", before, option->name);
            before = " ";
        }
    }
}

/* A function that completes $word behind $before; before begins with = if the argument is attached. */
static void write_bash_function(FILE *stream, const cm_command *command)
{
    const cm_option operand = operand_of(command);
    const cm_option *option;
    write_function_name(stream, command->name);
    fputs("_words()\n{\n    case $before in\n", stream);
    for (size_t i = 0; (option = cm_options_at(command, i)) != NULL; i++)
    {
        write_bash_case(stream, option);
    }
    fputs("        *)\n            if [[ $word == -* ]]; then\n"
          "                mapfile -t COMPREPLY < <(compgen -W '",
          stream);
    write_bash_names(stream, command);
    fputs("' -- \"$word\")\n            else\n                ", stream);
    write_bash_reply(stream, &operand);
    fputs("\n", stream);
    fputs("            fi\n            ;;\n    esac\n}\n\n", stream);
}

static void write_bash_choice_of_command(FILE *stream, const cm_command *command)
{
    fputs("    case ${words[1]-} in\n", stream);
    for (size_t i = 0; command->commands[i] != NULL; i++)
    {
        fprintf(stream, "        %s) ", last_word(command->commands[i]->name));
        write_function_name(stream, command->commands[i]->name);
        fputs("_words ;;\n", stream);
    }
    fputs("        *) ", stream);
    write_function_name(stream, command->name);
    fputs("_words ;;\n    esac\n", stream);
    fputs("    if ((${#words[@]} == 1)); then\n"
          "        mapfile -t -O \"${#COMPREPLY[@]}\" COMPREPLY < <(compgen -W '",
          stream);
    for (size_t i = 0; command->commands[i] != NULL; i++)
    {
        fprintf(stream, "%s%s", i == 0 ? "" : " ", last_word(command->commands[i]->name));
    }
    fputs("' -- \"$word\")\n    fi\n", stream);
}

/* The word up to the cursor is cut out of the line, since bash breaks words at : and =, which mappings have. */
static void write_bash(FILE *stream, const cm_command *command)
{
    fprintf(stream, "# Completion of %s for bash.\n\n", command->name);
    write_bash_function(stream, command);
    for (size_t i = 0; command->commands != NULL && command->commands[i] != NULL; i++)
    {
        write_bash_function(stream, command->commands[i]);
    }
    write_function_name(stream, command->name);
    fputs("()\n{\n"
          "    local line=${COMP_LINE:0:COMP_POINT} word before words cut\n"
          "    word=${line##*[[:space:]]}\n"
          "    read -ra words <<<\"${line%\"$word\"}\"\n"
          "    before=${words[${#words[@]} - 1]}\n"
          "    if [[ $word == --*=* ]]; then\n"
          "        before=\"=${word%%=*}\" word=${word#*=}\n"
          "    fi\n"
          "    COMPREPLY=()\n",
          stream);
    if (command->commands != NULL)
    {
        write_bash_choice_of_command(stream, command);
    }
    else
    {
        fputs("    ", stream);
        write_function_name(stream, command->name);
        fputs("_words\n", stream);
    }
    fputs("    # bash replaces only what follows the last break\n"
          "    cut=${word%\"${word##*[:=]}\"}\n"
          "    COMPREPLY=(\"${COMPREPLY[@]#\"$cut\"}\")\n}\n\ncomplete -F ",
          stream);
    write_function_name(stream, command->name);
    fprintf(stream, " %s\n", command->name);
}

/* ------------------------------------------------------------------------------- zsh */

/* ":what it is:what completes it" */
static void write_zsh_action(FILE *stream, const cm_option *option)
{
    if (option->kind == CM_OPTION_FILE)
    {
        fputs("_files", stream);
    }
    else if (has_choices(option))
    {
        putc('(', stream);
        write_words(stream, option, ":");
        putc(')', stream);
    }
    else
    {
        putc(' ', stream);
    }
}

static void write_zsh_option(FILE *stream, const cm_option *option)
{
    char text[OPTION_TEXT_MAX];
    const bool optional = (option->flags & CM_OPTION_OPTIONAL) != 0;
    const char *const attached = option->kind == CM_OPTION_NONE ? "" : optional ? "=-" : "=";
    if (option->letter != '\0')
    {
        fprintf(stream, "        '(-%c --%s)'{-%c%s,--%s%s}'[", option->letter, option->name,
                option->letter, *attached != '\0' ? "+" : "", option->name, attached);
    }
    else
    {
        fprintf(stream, "        '--%s%s[", option->name, attached);
    }
    option_summary(option, text);
    write_quoted(stream, text, "[]:\\");
    putc(']', stream);
    if (option->kind != CM_OPTION_NONE)
    {
        fputs(optional ? "::" : ":", stream);
        write_quoted(stream, option->argument, ":\\");
        putc(':', stream);
        write_zsh_action(stream, option);
    }
    fputs("' \\\n", stream);
}

static void write_zsh_function(FILE *stream, const cm_command *command)
{
    const cm_option operand = operand_of(command);
    const cm_option *option;
    write_function_name(stream, command->name);
    fputs("_words()\n{\n    _arguments -s -S \\\n", stream);
    for (size_t i = 0; (option = cm_options_at(command, i)) != NULL; i++)
    {
        if (is_listed(option))
        {
            write_zsh_option(stream, option);
        }
    }
    if (operand.kind != CM_OPTION_NONE)
    {
        fputs("        '*:argument:", stream);
        write_zsh_action(stream, &operand);
        putc('\'', stream);
    }
    fputs("\n}\n\n", stream);
}

static void write_zsh_choice_of_command(FILE *stream, const cm_command *command)
{
    fputs("    case ${words[2]-} in\n", stream);
    for (size_t i = 0; command->commands[i] != NULL; i++)
    {
        fprintf(stream, "        %s) shift words; ((CURRENT--)); ",
                last_word(command->commands[i]->name));
        write_function_name(stream, command->commands[i]->name);
        fputs("_words ;;\n", stream);
    }
    fputs("        *)\n            ((CURRENT == 2)) && compadd", stream);
    for (size_t i = 0; command->commands[i] != NULL; i++)
    {
        fprintf(stream, " %s", last_word(command->commands[i]->name));
    }
    fputs("\n            ", stream);
    write_function_name(stream, command->name);
    fputs("_words\n            ;;\n    esac\n", stream);
}

static void write_zsh(FILE *stream, const cm_command *command)
{
    fprintf(stream, "#compdef %s\n# Completion of %s for zsh.\n\n", command->name, command->name);
    write_zsh_function(stream, command);
    for (size_t i = 0; command->commands != NULL && command->commands[i] != NULL; i++)
    {
        write_zsh_function(stream, command->commands[i]);
    }
    write_function_name(stream, command->name);
    fputs("()\n{\n", stream);
    if (command->commands != NULL)
    {
        write_zsh_choice_of_command(stream, command);
    }
    else
    {
        fputs("    ", stream);
        write_function_name(stream, command->name);
        fputs("_words\n", stream);
    }
    fputs("}\n\n", stream);
    write_function_name(stream, command->name);
    fputs(" \"$@\"\n", stream);
}

/* ------------------------------------------------------------------------------- fish */

static void write_fish_option(FILE *stream, const cm_option *option, const char *program,
                              const char *condition)
{
    char text[OPTION_TEXT_MAX];
    const bool optional = (option->flags & CM_OPTION_OPTIONAL) != 0;
    fprintf(stream, "complete -c %s%s -l %s", program, condition, option->name);
    if (option->letter != '\0')
    {
        fprintf(stream, " -s %c", option->letter);
    }
    if (option->kind == CM_OPTION_FILE)
    {
        fputs(" -r -F", stream);
    }
    else if (option->kind != CM_OPTION_NONE)
    {
        fputs(optional ? "" : " -x", stream);
    }
    if (option->kind != CM_OPTION_FILE && has_choices(option))
    {
        fputs(" -a '", stream);
        write_words(stream, option, "\\");
        fputs("'", stream);
    }
    option_summary(option, text);
    fputs(" -d '", stream);
    write_quoted(stream, text, "\\");
    fputs("'\n", stream);
}

static void write_fish_options(FILE *stream, const cm_command *command, const char *program,
                               const char *condition)
{
    const cm_option operand = operand_of(command);
    const cm_option *option;
    for (size_t i = 0; (option = cm_options_at(command, i)) != NULL; i++)
    {
        if (is_listed(option))
        {
            write_fish_option(stream, option, program, condition);
        }
    }
    if (operand.kind != CM_OPTION_FILE)
    {
        fprintf(stream, "complete -c %s%s -f", program, condition);
        if (has_choices(&operand))
        {
            fputs(" -a '", stream);
            write_words(stream, &operand, "\\");
            fputs("'", stream);
        }
        fputs("\n", stream);
    }
}

static void write_fish(FILE *stream, const cm_command *command)
{
    char condition[OPTION_TEXT_MAX] = " -n 'not __fish_seen_subcommand_from";
    fprintf(stream, "# Completion of %s for fish.\n\n", command->name);
    if (command->commands == NULL)
    {
        write_fish_options(stream, command, command->name, "");
        return;
    }
    for (size_t i = 0; command->commands[i] != NULL; i++)
    {
        const char *const word = last_word(command->commands[i]->name);
        const size_t used = strlen(condition);
        snprintf(condition + used, sizeof condition - used, " %s", word);
        fprintf(stream, "complete -c %s -n __fish_is_first_token -a %s\n", command->name, word);
    }
    strncat(condition, "'", sizeof condition - strlen(condition) - 1);
    write_fish_options(stream, command, command->name, condition);
    for (size_t i = 0; command->commands[i] != NULL; i++)
    {
        snprintf(condition, sizeof condition, " -n '__fish_seen_subcommand_from %s'",
                 last_word(command->commands[i]->name));
        write_fish_options(stream, command->commands[i], command->name, condition);
    }
}

void cm_options_write_completion(FILE *stream, const cm_command *command, const char *shell)
{
    if (strcmp(shell, "zsh") == 0)
    {
        write_zsh(stream, command);
    }
    else if (strcmp(shell, "fish") == 0)
    {
        write_fish(stream, command);
    }
    else
    {
        write_bash(stream, command);
    }
}
