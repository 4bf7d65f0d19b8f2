/* SPDX-License-Identifier: MIT
 *
 * Plans as text: lines of a word and its value, as
 *
 *     cubemap-plan 1
 *     from equirect;size=4096;height=2048
 *     to cube:coupled;frame=geo;layout=faces;size=1024
 *     to-rotation 1 0 0 0 1 0 0 0 1
 *     filter lanczos3
 *     tolerance 0.000244140625
 *
 * What is as it is without a word is left away.
 */
#include "resample_plan.h"
#include "surface_specification.h"

#include <cubemap/number.h>

#include <stdlib.h>
#include <string.h>

#include "text_end.h"

#define FIRST_LINE "cubemap-plan 1\n"

/* ---- writing ---- */

static void put_line(cm_text_end *page, const char *word, const char *value)
{
    cm_text_add(page, word);
    cm_text_add(page, " ");
    cm_text_add(page, value);
    cm_text_add(page, "\n");
}

static void put_number(cm_text_end *page, const char *word, double value)
{
    char text[CM_NUMBER_SIZE];
    cm_number_write_shortest(value, text);
    put_line(page, word, text);
}

static void put_rotation(cm_text_end *page, const char *word, const cm_surface *surface)
{
    if (surface->is_turned)
    {
        cm_text_add(page, word);
        for (int i = 0; i < 9; i++)
        {
            cm_text_add(page, " ");
            cm_text_add_number(page, surface->rotation.row[i / 3][i % 3]);
        }
        cm_text_add(page, "\n");
    }
}

/* Options that are whole numbers, and the greatest value of each. */
typedef struct plan_whole
{
    const char *word;
    double most;
} plan_whole;

static const plan_whole wholes[] = {
    {"transfer", CM_TRANSFER_GAMMA}, {"alpha", CM_CHANNELS_MAX},         {"alpha-multiplied", 1},
    {"vector", CM_CHANNELS_MAX},     {"not-finite", CM_NOT_FINITE_ZERO}, {"dither", 1}};
#define WHOLES (sizeof wholes / sizeof *wholes)

static double whole_of(const cm_plan_options *options, size_t index)
{
    const double values[WHOLES] = {
        options->transfer, options->alpha,      options->alpha_multiplied != 0,
        options->vector,   options->not_finite, options->dither != 0};
    return values[index];
}

static void set_whole(cm_plan_options *options, size_t index, double value)
{
    switch (index)
    {
    case 0:
        options->transfer = (cm_transfer)value;
        break;
    case 1:
        options->alpha = (uint32_t)value;
        break;
    case 2:
        options->alpha_multiplied = (int)value;
        break;
    case 3:
        options->vector = (uint32_t)value;
        break;
    case 4:
        options->not_finite = (cm_not_finite)value;
        break;
    default:
        options->dither = (int)value;
        break;
    }
}

cm_status cm_plan_write(const cm_plan *plan, char *text, size_t size, size_t *length)
{
    if (plan == NULL || (text == NULL && size > 0))
    {
        return CM_ERROR_ARGUMENT;
    }
    const cm_plan_options *options = &plan->options;
    cm_text_end page = {text, size, 0};
    cm_text_add(&page, FIRST_LINE);
    put_line(&page, "from", cm_surface_specification(plan->from));
    put_rotation(&page, "from-rotation", plan->from);
    put_line(&page, "to", cm_surface_specification(plan->to));
    put_rotation(&page, "to-rotation", plan->to);
    put_line(&page, "filter", cm_filter_name(options->filter));
    put_number(&page, "tolerance", options->tolerance == 0.0 ? -1.0 : options->tolerance);
    put_number(&page, "pixels-most", options->pixels_most);
    put_number(&page, "gamma", options->gamma);
    for (size_t i = 0; i < WHOLES; i++)
    {
        put_number(&page, wholes[i].word, whole_of(options, i));
    }
    if (length != NULL)
    {
        *length = page.length;
    }
    return page.length < size ? CM_OK : CM_ERROR_SPACE;
}

/* ---- reading ---- */

/* What the lines have said. */
typedef struct plan_words
{
    char from[CM_SURFACE_TEXT];
    char to[CM_SURFACE_TEXT];
    cm_rotation from_rotation;
    cm_rotation to_rotation;
    int from_turned;
    int to_turned;
    cm_plan_options options;
} plan_words;

static cm_status read_rotation(cm_word text, cm_rotation *rotation)
{
    for (int i = 0; i < 9; i++)
    {
        const size_t length = cm_number_read(text.text, text.length, &rotation->row[i / 3][i % 3]);
        const size_t blank = i < 8 ? 1 : 0;
        if (length == 0 || text.length < length + blank || (blank && text.text[length] != ' '))
        {
            return CM_ERROR_SYNTAX;
        }
        text.text += length + blank;
        text.length -= length + blank;
    }
    return text.length == 0 ? cm_rotation_check(rotation) : CM_ERROR_SYNTAX;
}

static cm_status read_filter(cm_word value, cm_filter *filter)
{
    for (int i = 0; cm_filter_name((cm_filter)i) != NULL; i++)
    {
        if (cm_word_is(value, cm_filter_name((cm_filter)i)))
        {
            *filter = (cm_filter)i;
            return CM_OK;
        }
    }
    return CM_ERROR_SYNTAX;
}

static cm_status read_number(cm_word key, cm_word value, cm_plan_options *options)
{
    double number;
    if (!cm_number_parse(value.text, value.length, &number))
    {
        return CM_ERROR_SYNTAX;
    }
    double *const real[] = {&options->tolerance, &options->pixels_most, &options->gamma};
    static const char *const words[] = {"tolerance", "pixels-most", "gamma"};
    for (size_t i = 0; i < 3; i++)
    {
        if (cm_word_is(key, words[i]))
        {
            *real[i] = number;
            return CM_OK;
        }
    }
    for (size_t i = 0; i < WHOLES; i++)
    {
        if (cm_word_is(key, wholes[i].word))
        {
            const int good =
                number >= 0.0 && number <= wholes[i].most && number == (double)(uint32_t)number;
            set_whole(options, i, good ? number : 0.0);
            return good ? CM_OK : CM_ERROR_RANGE;
        }
    }
    return CM_ERROR_PARAMETER;
}

static cm_status read_line(cm_word key, cm_word value, plan_words *words)
{
    if (cm_word_is(key, "from") || cm_word_is(key, "to"))
    {
        char *to = cm_word_is(key, "from") ? words->from : words->to;
        return cm_word_copy(value, to, CM_SURFACE_TEXT) ? CM_OK : CM_ERROR_SYNTAX;
    }
    if (cm_word_is(key, "from-rotation"))
    {
        words->from_turned = 1;
        return read_rotation(value, &words->from_rotation);
    }
    if (cm_word_is(key, "to-rotation"))
    {
        words->to_turned = 1;
        return read_rotation(value, &words->to_rotation);
    }
    return cm_word_is(key, "filter") ? read_filter(value, &words->options.filter)
                                     : read_number(key, value, &words->options);
}

static cm_status read_lines(cm_word rest, plan_words *words)
{
    cm_status status = CM_OK;
    while (rest.length > 0 && status == CM_OK)
    {
        cm_word value;
        const cm_word line = cm_word_split(rest, '\n', &rest);
        const cm_word key = cm_word_split(line, ' ', &value);
        /* what ends in the middle of a line is cut */
        status = rest.text == NULL || value.text == NULL ? CM_ERROR_SYNTAX
                                                         : read_line(key, value, words);
    }
    return status;
}

cm_status cm_plan_read(const char *text, size_t length, const char *instructions, cm_plan **plan)
{
    const size_t first = sizeof FIRST_LINE - 1;
    if (text == NULL || plan == NULL)
    {
        return CM_ERROR_ARGUMENT;
    }
    if (length < first || memcmp(text, FIRST_LINE, first) != 0)
    {
        return CM_ERROR_SYNTAX;
    }
    plan_words words = {.options = {.size = sizeof words.options, .instructions = instructions}};
    cm_status status = read_lines((cm_word){text + first, length - first}, &words);
    const cm_surface_options from = {.size = sizeof from,
                                     .rotation = words.from_turned ? &words.from_rotation : NULL,
                                     .instructions = instructions};
    const cm_surface_options to = {.size = sizeof to,
                                   .rotation = words.to_turned ? &words.to_rotation : NULL,
                                   .instructions = instructions};
    cm_surface *source = NULL;
    cm_surface *target = NULL;
    status = status == CM_OK ? cm_surface_create(words.from, &from, &source) : status;
    status = status == CM_OK ? cm_surface_create(words.to, &to, &target) : status;
    status = status == CM_OK ? cm_plan_create(source, target, &words.options, plan) : status;
    cm_surface_destroy(source);
    cm_surface_destroy(target);
    return status;
}
