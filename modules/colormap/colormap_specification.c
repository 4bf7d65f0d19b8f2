/* SPDX-License-Identifier: MIT
 *
 * Specifications: NAME[:PARAMETER=VALUE[,PARAMETER=VALUE...]].
 */
#include "colormap_specification.h"

#include <cubemap/number.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* A part of the specification, and as much of it as a message shows. */
typedef struct word
{
    const char *text;
    size_t length;
} word;

static int shown(word w)
{
    return w.length < 40 ? (int)w.length : 40;
}

/* Where a message goes. */
typedef struct complaint
{
    char *message;
    size_t size;
} complaint;

/* One line, whatever the words of the specification are. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static cm_status
fail(complaint to, cm_status status, const char *format, ...)
{
    if (to.message != NULL && to.size > 0)
    {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(to.message, to.size, format, arguments);
        va_end(arguments);
        for (char *c = to.message; *c != '\0'; c++)
        {
            *c = (unsigned char)*c < 0x20 || *c == 0x7f ? '?' : *c;
        }
    }
    return status;
}

/* The word up to one of the stops or the end; *rest is what follows the stop, NULL at the end. */
static word split(word whole, char stop, word *rest)
{
    const char *found = memchr(whole.text, stop, whole.length);
    rest->text = found == NULL ? NULL : found + 1;
    rest->length = found == NULL ? 0 : whole.length - (size_t)(found + 1 - whole.text);
    return (word){whole.text, found == NULL ? whole.length : (size_t)(found - whole.text)};
}

/* -0 is 0 here. */
static int read_decimal(word text, double *value)
{
    if (!cm_number_parse(text.text, text.length, value))
    {
        return 0;
    }
    *value += 0.0;
    return 1;
}

/* subject says what of the parameter is read: "", or "a place in ". */
static cm_status read_number(const cm_colormap_info *info, const cm_colormap_parameter_info *what,
                             const char *subject, word text, double *value, complaint to)
{
    if (!read_decimal(text, value))
    {
        return fail(to, CM_ERROR_SYNTAX, "'%.*s' is not a number for %sparameter %s of %s",
                    shown(text), text.text, subject, what->name, info->identifier);
    }
    if (!(*value >= what->low && *value <= what->high) ||
        (what->low_excluded && *value == what->low))
    {
        char low[CM_NUMBER_SIZE];
        char high[CM_NUMBER_SIZE];
        cm_number_write_shortest(what->low, low);
        cm_number_write_shortest(what->high, high);
        return fail(to, CM_ERROR_RANGE, "%sparameter %s of %s is %.*s; it must be in %s%s, %s]",
                    subject, what->name, info->identifier, shown(text), text.text,
                    what->low_excluded ? "(" : "[", low, high);
    }
    return CM_OK;
}

/* ---- lists of stops ---- */

static cm_status read_place(const cm_colormap_info *info, const cm_colormap_parameter_info *what,
                            word text, double *place, complaint to)
{
    const cm_colormap_parameter_info range = {.name = what->name, .low = 0.0, .high = 1.0};
    return read_number(info, &range, "a place in ", text, place, to);
}

/* HUE[@PLACE]; *placed is whether there is a place. */
static cm_status read_stop(const cm_colormap_info *info, const cm_colormap_parameter_info *what,
                           word text, size_t index, cm_colormap_parameters *parameters, int *placed,
                           complaint to)
{
    word place;
    const word hue = split(text, '@', &place);
    *placed = place.text != NULL;
    cm_status status = read_number(info, what, "", hue, &parameters->hue[index], to);
    if (status == CM_OK && *placed)
    {
        status = read_place(info, what, place, &parameters->place[index], to);
    }
    if (status == CM_OK && *placed && index > 0 &&
        !(parameters->place[index] > parameters->place[index - 1]))
    {
        return fail(to, CM_ERROR_RANGE,
                    "the places of parameter %s of %s must grow, but %.*s is not above the one "
                    "before",
                    what->name, info->identifier, shown(place), place.text);
    }
    return status;
}

/* Places of stops that have none. */
static void spread(cm_colormap_parameters *parameters)
{
    const size_t last = parameters->stop_count - 1;
    for (size_t i = 0; i <= last; i++)
    {
        parameters->place[i] = last == 0 ? 0.0 : (double)i / (double)last;
    }
}

static cm_status read_stops(const cm_colormap_info *info, const cm_colormap_parameter_info *what,
                            word text, cm_colormap_parameters *parameters, complaint to)
{
    size_t count = 0;
    size_t placed_count = 0;
    for (word rest = text; rest.text != NULL; count++)
    {
        int placed;
        if (count == CM_COLORMAP_STOPS_MAX)
        {
            return fail(to, CM_ERROR_RANGE, "parameter %s of %s has more than %d stops", what->name,
                        info->identifier, CM_COLORMAP_STOPS_MAX);
        }
        const word stop = split(rest, '/', &rest);
        const cm_status status = read_stop(info, what, stop, count, parameters, &placed, to);
        if (status != CM_OK)
        {
            return status;
        }
        placed_count += placed != 0;
    }
    if (placed_count != 0 && placed_count != count)
    {
        return fail(to, CM_ERROR_SYNTAX,
                    "of the stops of parameter %s of %s either all have a place, as in 90@0.5, or "
                    "none",
                    what->name, info->identifier);
    }
    parameters->stop_count = count;
    if (placed_count == 0)
    {
        spread(parameters);
    }
    return CM_OK;
}

/* ---- the whole ---- */

/* "hue, lightness, saturation" */
static void list_parameters(const cm_colormap_info *info, char *text, size_t size)
{
    size_t length = 0;
    for (size_t i = 0; i < info->parameter_count && length < size; i++)
    {
        length += (size_t)snprintf(text + length, size - length, "%s%s", i == 0 ? "" : ", ",
                                   info->parameter[i].name);
    }
}

static void list_models(char *text, size_t size)
{
    size_t length = 0;
    for (size_t i = 0; i < cm_colormap_count() && length < size; i++)
    {
        length += (size_t)snprintf(text + length, size - length, "%s%s", i == 0 ? "" : ", ",
                                   cm_colormap_at(i)->identifier);
    }
}

static cm_status read_assignment(const cm_colormap_info *info, word text, unsigned *given,
                                 cm_colormap_parameters *parameters, complaint to)
{
    char known[400];
    word value;
    const word name = split(text, '=', &value);
    list_parameters(info, known, sizeof known);
    if (info->parameter_count == 0)
    {
        return fail(to, CM_ERROR_PARAMETER, "%s has no parameters, so '%.*s' is too much",
                    info->identifier, shown(text), text.text);
    }
    if (value.text == NULL)
    {
        return fail(to, CM_ERROR_SYNTAX, "'%.*s' is not PARAMETER=VALUE; %s has %s", shown(text),
                    text.text, info->identifier, known);
    }
    size_t i = 0;
    while (i < info->parameter_count &&
           !cm_colormap_same_word(info->parameter[i].name, strlen(info->parameter[i].name),
                                  name.text, name.length))
    {
        i++;
    }
    if (i == info->parameter_count)
    {
        return fail(to, CM_ERROR_PARAMETER, "%s has no parameter '%.*s'; it has %s",
                    info->identifier, shown(name), name.text, known);
    }
    if (*given & (1u << i))
    {
        return fail(to, CM_ERROR_PARAMETER, "parameter %s of %s is given twice",
                    info->parameter[i].name, info->identifier);
    }
    *given |= 1u << i;
    return info->parameter[i].stops != NULL
               ? read_stops(info, &info->parameter[i], value, parameters, to)
               : read_number(info, &info->parameter[i], "", value, &parameters->value[i], to);
}

static void set_standard(const cm_colormap_info *info, cm_colormap_parameters *parameters)
{
    const complaint nobody = {NULL, 0};
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        const cm_colormap_parameter_info *what = &info->parameter[i];
        parameters->value[i] = what->standard;
        if (what->stops != NULL)
        {
            const word stops = {what->stops, strlen(what->stops)};
            (void)read_stops(info, what, stops, parameters, nobody);
        }
    }
}

cm_status cm_colormap_parse(const char *specification, cm_colormap_parameters *parameters,
                            char *message, size_t message_size)
{
    const complaint to = {message, message_size};
    word rest;
    const word whole = {specification, strlen(specification)};
    const word name = split(whole, ':', &rest);
    const cm_colormap_info *info = cm_colormap_find_word(name.text, name.length);
    if (info == NULL)
    {
        char known[400];
        list_models(known, sizeof known);
        return fail(to, name.length == 0 ? CM_ERROR_SYNTAX : CM_ERROR_MAPPING,
                    "no colour map is called '%.*s'; there are %s", shown(name), name.text, known);
    }
    cm_colormap_parameters read = {.index = (size_t)(info - cm_colormap_at(0))};
    unsigned given = 0;
    set_standard(info, &read);
    while (rest.text != NULL)
    {
        const word assignment = split(rest, ',', &rest);
        const cm_status status = read_assignment(info, assignment, &given, &read, to);
        if (status != CM_OK)
        {
            return status;
        }
    }
    *parameters = read;
    return CM_OK;
}

cm_status cm_colormap_check(const char *specification, char *message, size_t message_size)
{
    cm_colormap_parameters parameters;
    if (specification == NULL)
    {
        const complaint to = {message, message_size};
        return fail(to, CM_ERROR_ARGUMENT, "no colour map is given");
    }
    return cm_colormap_parse(specification, &parameters, message, message_size);
}

/* ---- writing ---- */

/* A text that grows in a buffer that may be too small. */
typedef struct growing
{
    char *text;
    size_t size;
    size_t length;
} growing;

static void add(growing *to, const char *text)
{
    for (; *text != '\0'; text++, to->length++)
    {
        if (to->length + 1 < to->size)
        {
            to->text[to->length] = *text;
        }
    }
}

static void add_number(growing *to, double value)
{
    char text[CM_NUMBER_SIZE];
    cm_number_write_shortest(value, text);
    add(to, text);
}

static void add_stops(growing *to, const cm_colormap_parameters *parameters)
{
    for (size_t i = 0; i < parameters->stop_count; i++)
    {
        add(to, i == 0 ? "" : "/");
        add_number(to, parameters->hue[i]);
        add(to, "@");
        add_number(to, parameters->place[i]);
    }
}

size_t cm_colormap_write(const cm_colormap_parameters *parameters, char *text, size_t size)
{
    const cm_colormap_info *info = cm_colormap_at(parameters->index);
    growing to = {text, size, 0};
    add(&to, info->identifier);
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        add(&to, i == 0 ? ":" : ",");
        add(&to, info->parameter[i].name);
        add(&to, "=");
        if (info->parameter[i].stops != NULL)
        {
            add_stops(&to, parameters);
        }
        else
        {
            add_number(&to, parameters->value[i]);
        }
    }
    if (size > 0)
    {
        text[to.length < size ? to.length : size - 1] = '\0';
    }
    return to.length;
}
