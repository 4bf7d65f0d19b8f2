/* SPDX-License-Identifier: MIT
 *
 * Specifications: NAME[:PARAMETER=VALUE[,PARAMETER=VALUE...]], NAME:PRESET, and
 * LAYOUT[:AZIMUTHAL,SQUARE[,PARAMETER=VALUE...]].
 */
#include <cubemap/cubemap.h>
#include <cubemap/kernels.h>

#include "libcubemap/batch/mapping_object.h"
#include "catalogue_words.h"
#include "specification.h"
#include "message.h"

#include <stdio.h>
#include <string.h>

static const cm_parameter_info *find_parameter(const cm_mapping_info *info, const char *name,
                                               size_t length, size_t *index)
{
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        const cm_parameter_info *parameter = &info->parameter[i];
        if (cm_word_equal(parameter->name, strlen(parameter->name), name, length))
        {
            *index = i;
            return parameter;
        }
    }
    return NULL;
}

static int inside(const cm_parameter_info *parameter, double value)
{
    return (parameter->low_excluded ? value > parameter->low : value >= parameter->low) &&
           value <= parameter->high && (!parameter->whole || value == (double)(long)value);
}

/* What a word of "NAME:WHAT NAME:WHAT..." stands for; its length is counted up to a blank. NULL if there is
 * no such word. */
static const char *find_preset(const char *presets, const char *name, size_t length)
{
    for (const char *preset = presets == NULL ? "" : presets; *preset != '\0';)
    {
        size_t word = strcspn(preset, ":");
        if (cm_word_equal(preset, word, name, length))
        {
            return preset + word + 1;
        }
        preset += strcspn(preset, " ");
        preset += strspn(preset, " ");
    }
    return NULL;
}

enum
{
    NAMES_SIZE = 96 /* of a list of names in a message */
};

/* Cut where the list is full. */
static void append(char names[NAMES_SIZE], const char *text, size_t length)
{
    size_t used = strlen(names);
    size_t room = NAMES_SIZE - 1 - used;
    size_t taken = length < room ? length : room;
    memcpy(names + used, text, taken);
    names[used + taken] = '\0';
}

static void append_name(char names[NAMES_SIZE], const char *name, size_t length)
{
    append(names, ", ", names[0] == '\0' ? 0 : 2);
    append(names, name, length);
}

/* "kappa, l1, l2" */
static void list_parameters(const cm_mapping_info *info, char names[NAMES_SIZE])
{
    names[0] = '\0';
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        append_name(names, info->parameter[i].name, strlen(info->parameter[i].name));
    }
}

/* "mild, balanced, isotropic" */
static void list_presets(const cm_mapping_info *info, char names[NAMES_SIZE])
{
    names[0] = '\0';
    for (const char *preset = info->presets; *preset != '\0';)
    {
        append_name(names, preset, strcspn(preset, ":"));
        preset += strcspn(preset, " ");
        preset += strspn(preset, " ");
    }
}

/* What is wrong with a word that has no '='. */
static cm_status refuse_word(const cm_mapping_info *info, const char *text, size_t length,
                             char *message, size_t size)
{
    char names[NAMES_SIZE];
    int shown = length < 40 ? (int)length : 40;
    if (info->presets == NULL)
    {
        return cm_fail(CM_ERROR_SYNTAX, message, size,
                       "'%.*s' is not PARAMETER=VALUE, as in tangent:c=1.1823", shown, text);
    }
    if (find_preset(info->presets, text, length) != NULL)
    {
        return cm_fail(CM_ERROR_PARAMETER, message, size,
                       "preset '%.*s' of %s stands alone: it sets every parameter", shown, text,
                       info->identifier);
    }
    list_presets(info, names);
    return cm_fail(CM_ERROR_SYNTAX, message, size,
                   "'%.*s' is neither a preset of %s, which are %s, nor PARAMETER=VALUE", shown,
                   text, info->identifier, names);
}

/* A parameter that there is not. */
static cm_status refuse_parameter(const cm_mapping_info *info, const char *name, int shown,
                                  char *message, size_t size)
{
    char names[NAMES_SIZE];
    list_parameters(info, names);
    return cm_fail(CM_ERROR_PARAMETER, message, size, "mapping %s has no parameter '%.*s'; it %s%s",
                   info->identifier, shown, name,
                   info->parameter_count == 0 ? "takes none" : "has ", names);
}

/* One PARAMETER=VALUE of the given length. */
static cm_status parse_assignment(const cm_mapping_info *info, const char *text, size_t length,
                                  unsigned *given, double *values, char *message, size_t size)
{
    const char *equals = memchr(text, '=', length);
    size_t name_length = equals == NULL ? length : (size_t)(equals - text);
    int shown = name_length < 40 ? (int)name_length : 40;
    size_t index = 0;
    if (equals == NULL)
    {
        return refuse_word(info, text, length, message, size);
    }
    const cm_parameter_info *parameter = find_parameter(info, text, name_length, &index);
    if (parameter == NULL)
    {
        return refuse_parameter(info, text, shown, message, size);
    }
    if (*given & (1u << index))
    {
        return cm_fail(CM_ERROR_PARAMETER, message, size, "parameter %s of %s is given twice",
                       parameter->name, info->identifier);
    }
    const char *number = equals + 1;
    size_t number_length = length - name_length - 1;
    int number_shown = number_length < 40 ? (int)number_length : 40;
    if (!cm_number_parse(number, number_length, &values[index]))
    {
        return cm_fail(CM_ERROR_SYNTAX, message, size,
                       "'%.*s' is not a number for parameter %s of %s", number_shown, number,
                       parameter->name, info->identifier);
    }
    if (!inside(parameter, values[index]))
    {
        return cm_fail(CM_ERROR_RANGE, message, size,
                       "parameter %s of %s is %.*s; it must be%s in %s%g, %g]", parameter->name,
                       info->identifier, number_shown, number,
                       parameter->whole ? " a whole number" : "",
                       parameter->low_excluded ? "(" : "[", parameter->low, parameter->high);
    }
    *given |= 1u << index;
    return CM_OK;
}

/* PARAMETER=VALUE[,PARAMETER=VALUE...]; *given has the bits of those that there are. */
static cm_status parse_assignments(const cm_mapping_info *info, const char *text, size_t length,
                                   unsigned *given, double *values, char *message, size_t size)
{
    const char *end = text + length;
    for (;;)
    {
        const char *comma = memchr(text, ',', (size_t)(end - text));
        const char *stop = comma == NULL ? end : comma;
        cm_status status =
            parse_assignment(info, text, (size_t)(stop - text), given, values, message, size);
        if (status != CM_OK || comma == NULL)
        {
            return status;
        }
        text = comma + 1;
    }
}

/* Is it the index of a parameter that is given? */
static int is_given(const cm_mapping_info *info, const char *name, unsigned given)
{
    size_t index;
    return find_parameter(info, name, strlen(name), &index) != NULL && (given & (1u << index)) != 0;
}

static double *value_of(const cm_mapping_info *info, const char *name, double *values)
{
    size_t index;
    return find_parameter(info, name, strlen(name), &index) == NULL ? NULL : &values[index];
}

/* What the ranges of an azimuthal projection's parameters do not say. */
static cm_status check_azimuthal(const cm_mapping_info *info, unsigned given, double *values,
                                 char *message, size_t size)
{
    const double *full = value_of(info, "full", values);
    const double *beta = value_of(info, "beta", values);
    if (is_given(info, "full", given) && is_given(info, "fov", given))
    {
        return cm_fail(CM_ERROR_PARAMETER, message, size,
                       "%s has either fov or full, which is fov=360", info->identifier);
    }
    if (beta != NULL && *beta == 0.0 &&
        ((full != NULL && *full != 0.0) || *value_of(info, "fov", values) == 360.0))
    {
        return cm_fail(CM_ERROR_RANGE, message, size,
                       "with beta=0 %s has no map of the whole sphere; beta must be in (0, 1]",
                       info->identifier);
    }
    return CM_OK;
}

int cm_is_folded(const cm_mapping_info *info)
{
    return strcmp(info->identifier, "quincuncial") == 0;
}

/* ---- Layouts: border:AZIMUTHAL,SQUARE[,PARAMETER=VALUE...] ---- */

/* The part called so, after the word of its kind and a colon. */
static const cm_mapping_info *find_part(const char *kind, const char *name, size_t length)
{
    char whole[64];
    const char *fixed;
    int written = snprintf(whole, sizeof whole, "%s:%.*s", kind, (int)length, name);
    return written < 0 || (size_t)written >= sizeof whole
               ? NULL
               : cm_catalogue_find_word(whole, (size_t)written, &fixed);
}

/* Does the projection go to where the layout's square ends? */
static cm_status check_part(const cm_mapping_info *info, const cm_mapping_info *part, char *message,
                            size_t size)
{
    size_t index;
    int folded = cm_is_folded(info);
    const cm_parameter_info *fov = find_parameter(part, "fov", 3, &index);
    if (folded && fov->high < 180.0)
    {
        return cm_fail(CM_ERROR_PARAMETER, message, size,
                       "%s has no map of a hemisphere, as %s needs", part->identifier,
                       info->identifier);
    }
    if (!folded && fov->high < 360.0)
    {
        return cm_fail(CM_ERROR_PARAMETER, message, size,
                       "%s has no map of the whole sphere, as %s needs", part->identifier,
                       info->identifier);
    }
    return CM_OK;
}

static cm_status parse_part(const cm_mapping_info *info, const char *text, size_t length,
                            int *count, cm_specification *made, char *message, size_t size)
{
    const char *kind = *count == 0 ? "azimuthal" : "square";
    int shown = length < 40 ? (int)length : 40;
    const cm_mapping_info *part = *count < 2 ? find_part(kind, text, length) : NULL;
    if (part == NULL)
    {
        return cm_fail(*count < 2 ? CM_ERROR_MAPPING : CM_ERROR_SYNTAX, message, size,
                       *count < 2
                           ? "there is no %s:%.*s; it is %s:AZIMUTHAL,SQUARE, as in %s:%s"
                           : "%s:%.*s is one part too many; it is %s:AZIMUTHAL,SQUARE, as in %s:%s",
                       kind, shown, text, info->identifier, info->identifier, info->parts);
    }
    *(*count == 0 ? &made->azimuthal : &made->square) = cm_catalogue_index(part);
    return ++*count == 1 ? check_part(info, part, message, size) : CM_OK;
}

/* Words apart by commas, or colons: a part's name, or PARAMETER=VALUE. */
static cm_status parse_parts(const cm_mapping_info *info, const char *text, size_t length,
                             cm_specification *made, char *message, size_t size)
{
    int count = 0;
    unsigned given = 0;
    cm_status status = CM_OK;
    const char *end = text + length;
    for (int more = 1; status == CM_OK && more;)
    {
        const char *stop = text;
        while (stop < end && *stop != ',' && *stop != ':')
        {
            ++stop;
        }
        size_t word = (size_t)(stop - text);
        status = memchr(text, '=', word) != NULL
                     ? parse_assignment(info, text, word, &given, made->parameter, message, size)
                     : parse_part(info, text, word, &count, made, message, size);
        more = stop < end;
        text = stop + 1;
    }
    if (status != CM_OK)
    {
        return status;
    }
    if (count == 1)
    {
        return cm_fail(CM_ERROR_SYNTAX, message, size,
                       "%s has one part, and needs two: %s:AZIMUTHAL,SQUARE, as in %s:%s",
                       info->identifier, info->identifier, info->identifier, info->parts);
    }
    if (is_given(info, "beta", given) &&
        value_of(cm_catalogue_at(made->azimuthal), "beta", made->parameter) == NULL)
    {
        return cm_fail(CM_ERROR_PARAMETER, message, size, "%s has no parameter 'beta'; mixture has",
                       cm_catalogue_at(made->azimuthal)->identifier);
    }
    if (!cm_is_folded(info) &&
        value_of(cm_catalogue_at(made->azimuthal), "beta", made->parameter) != NULL &&
        *value_of(info, "beta", made->parameter) == 0.0)
    {
        return cm_fail(
            CM_ERROR_RANGE, message, size,
            "with beta=0 mixture has no map of the whole sphere; beta must be in (0, 1]");
    }
    return CM_OK;
}

/* ---- Specifications ---- */

/* The mapping that a specification begins with the name of, and the length of that: names may have a colon
 * in them. */
static const cm_mapping_info *find_in(const char *text, size_t *length, const char **fixed)
{
    size_t one = strcspn(text, ":");
    *length = text[one] == ':' ? one + 1 + strcspn(text + one + 1, ":,") : one;
    const cm_mapping_info *info = cm_catalogue_find_word(text, *length, fixed);
    if (info == NULL)
    {
        *length = one;
        info = cm_catalogue_find_word(text, one, fixed);
    }
    return info;
}

static cm_status refuse_name(const char *text, size_t length, char *message, size_t size)
{
    const cm_kind kind = cm_word_equal("square", 6, text, length)      ? CM_KIND_DISC_SQUARE
                         : cm_word_equal("azimuthal", 9, text, length) ? CM_KIND_AZIMUTHAL
                                                                       : CM_KIND_CUBE;
    if (kind == CM_KIND_CUBE)
    {
        return cm_fail(length == 0 ? CM_ERROR_SYNTAX : CM_ERROR_MAPPING, message, size,
                       "no mapping is called '%.*s'; " CM_MAPPING_RECOMMENDED
                       " is the recommended one, and the catalogue lists all",
                       length < 60 ? (int)length : 60, text);
    }
    char names[NAMES_SIZE] = "";
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        const cm_mapping_info *each = cm_catalogue_at(i);
        if (each->kind == kind)
        {
            append_name(names, each->identifier + length + 1,
                        strlen(each->identifier) - length - 1);
        }
    }
    return cm_fail(CM_ERROR_MAPPING, message, size, "after '%.*s:' comes one of %s", (int)length,
                   text, names);
}

cm_status cm_specification_parse(const char *specification, cm_specification *made, char *message,
                                 size_t message_size)
{
    const char *fixed;
    size_t length;
    const cm_mapping_info *info = find_in(specification, &length, &fixed);
    const char *rest = specification[length] == '\0' ? NULL : specification + length + 1;
    if (info == NULL)
    {
        return refuse_name(specification, length, message, message_size);
    }
    if (*fixed != '\0' && rest != NULL)
    {
        return cm_fail(CM_ERROR_PARAMETER, message, message_size,
                       "'%.*s' takes no parameters: it is %s:%.*s", (int)length, specification,
                       info->identifier, (int)strcspn(fixed, " "), fixed);
    }
    cm_specification read = {.index = cm_catalogue_index(info)};
    read.azimuthal = read.index;
    read.square = read.index;
    for (size_t i = 0; i < info->parameter_count; i++)
    {
        read.parameter[i] = info->parameter[i].standard;
    }
    const char *preset = rest == NULL ? NULL : find_preset(info->presets, rest, strlen(rest));
    const char *text = preset != NULL ? preset : rest != NULL ? rest : fixed;
    size_t text_length = rest != NULL && preset == NULL ? strlen(text) : strcspn(text, " ");
    unsigned given = 0;
    cm_status status = CM_OK;
    if (info->parts != NULL)
    {
        parse_parts(info, info->parts, strlen(info->parts), &read, NULL, 0);
        if (rest != NULL || *fixed != '\0')
        {
            status = parse_parts(info, text, text_length, &read, message, message_size);
        }
    }
    else if (rest != NULL || *fixed != '\0')
    {
        status = parse_assignments(info, text, text_length, &given, read.parameter, message,
                                   message_size);
    }
    if (status == CM_OK && info->kind == CM_KIND_AZIMUTHAL)
    {
        status = check_azimuthal(info, given, read.parameter, message, message_size);
    }
    if (status == CM_OK)
    {
        *made = read;
    }
    return status;
}

cm_status cm_specification_check(const char *specification, char *message, size_t message_size)
{
    cm_specification made;
    if (specification == NULL)
    {
        return cm_fail(CM_ERROR_ARGUMENT, message, message_size, "no mapping is given");
    }
    return cm_specification_parse(specification, &made, message, message_size);
}

static int is_as_read(const cm_mapping *mapping, const char *specification)
{
    cm_specification read;
    int same = cm_specification_parse(specification, &read, NULL, 0) == CM_OK &&
               mapping->azimuthal == read.azimuthal && mapping->square == read.square;
    for (size_t i = 0; same && i < mapping->info->parameter_count; i++)
    {
        same = mapping->parameter[i] == read.parameter[i];
    }
    return same;
}

int cm_mapping_has_bounds(const cm_mapping *mapping)
{
    const cm_mapping_info *info = mapping->info;
    char specification[128];
    int has = is_as_read(mapping, info->identifier);
    for (const char *preset = info->presets; preset != NULL && *preset != '\0' && !has;)
    {
        snprintf(specification, sizeof specification, "%s:%.*s", info->identifier,
                 (int)strcspn(preset, ":"), preset);
        has = is_as_read(mapping, specification);
        preset += strcspn(preset, " ");
        preset += strspn(preset, " ");
    }
    return has;
}
