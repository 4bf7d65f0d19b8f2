/* SPDX-License-Identifier: MIT */
#include "listing.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/cubemap.h>

/* What a mapping maps: a word for programs, a heading, and the room that names need. */
static const struct
{
    const char *word;
    const char *heading;
    int width;
} kinds[] = {
    [CM_KIND_CUBE] = {"cube", "Between the sphere and the six faces of a cube", 12},
    [CM_KIND_DISC_SQUARE] = {"disc-square", "Between the unit disc and the square", 18},
    [CM_KIND_AZIMUTHAL] = {"azimuthal", "Between the sphere, or a part of it, and the unit disc",
                           24},
    [CM_KIND_LAYOUT] = {"layout", "Between the sphere and one square", 20},
};

enum
{
    KIND_COUNT = sizeof kinds / sizeof kinds[0]
};

static const char *family_name(cm_family family)
{
    switch (family)
    {
    case CM_FAMILY_UNIVARIATE:
        return "univariate";
    case CM_FAMILY_BIVARIATE:
        return "bivariate";
    case CM_FAMILY_HYBRID:
        return "hybrid";
    }
    return "unknown";
}

/* One face has no edge to another, and no corner where three meet. */
static const char *edge_name(const cm_mapping_info *mapping)
{
    return mapping->kind == CM_KIND_CUBE ? cm_smoothness_name(mapping->smooth_edge) : NULL;
}

static const char *corner_name(const cm_mapping_info *mapping)
{
    return mapping->kind == CM_KIND_CUBE ? cm_smoothness_name(mapping->smooth_corner) : NULL;
}

static const char *property_name(unsigned properties)
{
    switch (properties & (CM_EQUAL_AREA | CM_CONFORMAL))
    {
    case CM_EQUAL_AREA:
        return "equal-area";
    case CM_CONFORMAL:
        return "conformal";
    default:
        return "-";
    }
}

/* ------------------------------------------------------------------------------- table */

static void write_heading(FILE *stream)
{
    fprintf(
        stream,
        "libcubemap %s: the mappings that -m takes, as NAME, NAME:PRESET or\n"
        "NAME:PARAMETER=VALUE,...\n"
        "The recommended one, and the default, is " CM_MAPPING_RECOMMENDED ".\n"
        "FACE, EDGE and CORNER say how smooth a mapping is on a face, across the edge of two and\n"
        "at a face's corners: torn, C0 (continuous), C1 or C2 (with its first derivatives, or the\n"
        "second too) or analytic.\n",
        cm_version());
}

static void write_kind_heading(FILE *stream, cm_kind kind)
{
    fprintf(stream, "\n%s:\n\n%-*s %-10s %-10s %-8s %-8s %-8s %s\n", kinds[kind].heading,
            kinds[kind].width, "NAME", "FAMILY", "PROPERTY", "FACE", "EDGE", "CORNER",
            "WHAT IT IS");
}

static void write_parameter_row(FILE *stream, const cm_parameter_info *parameter)
{
    char standard[CM_NUMBER_SIZE];
    char low[CM_NUMBER_SIZE];
    char high[CM_NUMBER_SIZE];
    cm_number_write_shortest(parameter->standard, standard);
    cm_number_write_shortest(parameter->low, low);
    cm_number_write_shortest(parameter->high, high);
    fprintf(stream, "    parameter  %s, %s%c%s, %s], default %s: %s\n", parameter->name,
            parameter->whole ? "whole, in " : "in ", parameter->low_excluded ? '(' : '[', low, high,
            standard, parameter->meaning);
}

/* The length of what is to be typed of a word: without the colon that values or parts follow. */
static int typed_length(const char *word, int length)
{
    int colon = length;
    bool fixes = false;
    for (int i = 0; i < length; i++)
    {
        colon = word[i] == ':' ? i : colon;
        fixes = fixes || word[i] == '=' || word[i] == ',';
    }
    return fixes ? colon : length;
}

/* "asc:c=1 eac:c=1" as "asc (c=1), eac (c=1)": the part behind the colon is not to be typed. */
static void write_word_row(FILE *stream, const char *before, const char *words)
{
    for (words += strspn(words, " "); *words != '\0'; words += strspn(words, " "))
    {
        const int length = (int)strcspn(words, " ");
        const int name_length = typed_length(words, length);
        fprintf(stream, "%s%.*s", before, name_length, words);
        if (name_length < length)
        {
            fprintf(stream, " (%.*s)", length - name_length - 1, words + name_length + 1);
        }
        words += length;
        before = ", ";
    }
    fputc('\n', stream);
}

static void write_mapping_rows(FILE *stream, const cm_mapping_info *mapping)
{
    const char *const edge = edge_name(mapping);
    const char *const corner = corner_name(mapping);
    fprintf(stream, "\n%-*s %-10s %-10s %-8s %-8s %-8s %s\n", kinds[mapping->kind].width,
            mapping->identifier, family_name(mapping->family), property_name(mapping->properties),
            cm_smoothness_name(mapping->smooth_face), edge != NULL ? edge : "-",
            corner != NULL ? corner : "-", mapping->name);
    if (mapping->aliases[0] != '\0')
    {
        write_word_row(stream, "    also       ", mapping->aliases);
    }
    if (mapping->parts != NULL)
    {
        fprintf(stream, "    parts      %s:AZIMUTHAL,SQUARE[,PARAMETER=VALUE,...], default %s\n",
                mapping->identifier, mapping->parts);
    }
    if (mapping->presets != NULL)
    {
        write_word_row(stream, "    preset     ", mapping->presets);
    }
    for (size_t i = 0; i < mapping->parameter_count; i++)
    {
        write_parameter_row(stream, &mapping->parameter[i]);
    }
    fprintf(stream, "    source     %s\n", mapping->source);
}

void listing_write_table(FILE *stream)
{
    write_heading(stream);
    for (int kind = 0; kind < KIND_COUNT; kind++)
    {
        write_kind_heading(stream, (cm_kind)kind);
        for (size_t i = 0; i < cm_catalogue_count(); i++)
        {
            if ((int)cm_catalogue_at(i)->kind == kind)
            {
                write_mapping_rows(stream, cm_catalogue_at(i));
            }
        }
    }
    fprintf(stream, "\nThe frames that --frame takes, with the faces of a cube:\n");
    for (size_t i = 0; i < cm_frame_count(); i++)
    {
        const cm_frame *const frame = cm_frame_at(i);
        fprintf(stream, "%-12s %s\n", frame->identifier, frame->name);
    }
    listing_write_ellipsoids(stream);
    listing_write_latitudes(stream);
    fprintf(stream, "\nThe orientations that --rotate takes by name, LON,LAT,ROLL:\n");
    for (size_t i = 0; i < cm_orientation_count(); i++)
    {
        const cm_orientation *const orientation = cm_orientation_at(i);
        fprintf(stream, "%-22s %8.2f %7.2f %8.2f  %s\n", orientation->identifier, orientation->lon,
                orientation->lat, orientation->roll, orientation->name);
    }
}

void listing_write_ellipsoids(FILE *stream)
{
    fprintf(stream, "\nThe ellipsoids that --ellipsoid takes by name, A in metres and 1/F:\n");
    for (size_t i = 0; i < cm_ellipsoid_count(); i++)
    {
        const cm_ellipsoid *const ellipsoid = cm_ellipsoid_at(i);
        fprintf(stream, "%-20s %14.3f %14.12g  %s\n", ellipsoid->identifier, ellipsoid->a,
                ellipsoid->f == 0 ? 0 : 1 / ellipsoid->f, ellipsoid->name);
    }
}

void listing_write_latitudes(FILE *stream)
{
    fprintf(stream, "\nThe latitudes:\n");
    for (int i = 0; i < CM_LATITUDE_COUNT; i++)
    {
        fprintf(stream, "%s\n", cm_latitude_name((cm_latitude)i));
    }
}

/* ------------------------------------------------------------------------------- JSON */

/* length bytes of text as a JSON string. */
static void write_text(FILE *stream, const char *text, size_t length)
{
    putc('"', stream);
    for (size_t i = 0; i < length; i++)
    {
        const unsigned char character = (unsigned char)text[i];
        if (character == '"' || character == '\\')
        {
            putc('\\', stream);
            putc(character, stream);
        }
        else if (character < ' ')
        {
            fprintf(stream, "\\u%04x", (unsigned)character);
        }
        else
        {
            putc(character, stream);
        }
    }
    putc('"', stream);
}

/* "key": "text", or null for NULL, and what follows it. */
static void write_member(FILE *stream, const char *key, const char *text, const char *after)
{
    fprintf(stream, "\"%s\": ", key);
    if (text == NULL)
    {
        fputs("null", stream);
    }
    else
    {
        write_text(stream, text, strlen(text));
    }
    fputs(after, stream);
}

/* JSON has no infinity and no NaN: null stands for them. */
static void write_number_member(FILE *stream, const char *key, double value)
{
    char text[CM_NUMBER_SIZE] = "null";
    if (isfinite(value))
    {
        cm_number_write_shortest(value, text);
    }
    fprintf(stream, "\"%s\": %s, ", key, text);
}

static const char *truth(bool value)
{
    return value ? "true" : "false";
}

/* Words apart by blanks, as an array. */
static void write_words(FILE *stream, const char *words)
{
    bool first = true;
    putc('[', stream);
    for (words += strspn(words, " "); *words != '\0'; words += strspn(words, " "))
    {
        const size_t length = strcspn(words, " ");
        fputs(first ? "" : ", ", stream);
        write_text(stream, words, length);
        words += length;
        first = false;
    }
    putc(']', stream);
}

static void write_parameter_object(FILE *stream, const cm_parameter_info *parameter)
{
    fputs("\n        {", stream);
    write_member(stream, "name", parameter->name, ", ");
    write_member(stream, "meaning", parameter->meaning, ", ");
    write_number_member(stream, "standard", parameter->standard);
    write_number_member(stream, "low", parameter->low);
    write_number_member(stream, "high", parameter->high);
    fprintf(stream, "\"low_excluded\": %s, \"whole\": %s}", truth(parameter->low_excluded != 0),
            truth(parameter->whole != 0));
}

/* In eps, 2^-53 in double and 2^-24 in float, as in <cubemap/catalogue.h>. */
static void write_bounds(FILE *stream, const cm_bounds *bounds)
{
    fputs("\"bounds_eps\": {", stream);
    write_number_member(stream, "round_trip", bounds->round_trip);
    write_number_member(stream, "plane_round_trip", bounds->plane_round_trip);
    write_number_member(stream, "forward", bounds->forward);
    write_number_member(stream, "inverse", bounds->inverse);
    char relative[CM_NUMBER_SIZE];
    cm_number_write_shortest(bounds->relative, relative);
    fprintf(stream, "\"relative\": %s}", relative);
}

/* In which directions there is the tier fast, by the bits. */
static const char *const fast_directions[] = {"", "forward", "inverse", "forward inverse"};

static void write_parameters(FILE *stream, const cm_mapping_info *mapping)
{
    fputs("\"parameters\": [", stream);
    for (size_t i = 0; i < mapping->parameter_count; i++)
    {
        fputs(i == 0 ? "" : ",", stream);
        write_parameter_object(stream, &mapping->parameter[i]);
    }
    fputs(mapping->parameter_count > 0 ? "\n      ]" : "]", stream);
}

static void write_mapping_object(FILE *stream, const cm_mapping_info *mapping)
{
    const char *const next = ",\n      ";
    fputs("    {\n      ", stream);
    write_member(stream, "identifier", mapping->identifier, ",\n      \"aliases\": ");
    write_words(stream, mapping->aliases);
    fputs(next, stream);
    write_member(stream, "name", mapping->name, next);
    write_member(stream, "source", mapping->source, next);
    write_member(stream, "kind", kinds[mapping->kind].word, next);
    write_member(stream, "parts", mapping->parts, next);
    write_member(stream, "family", family_name(mapping->family), next);
    fprintf(stream, "\"equal_area\": %s,\n      \"conformal\": %s%s",
            truth((mapping->properties & CM_EQUAL_AREA) != 0),
            truth((mapping->properties & CM_CONFORMAL) != 0), next);
    write_member(stream, "smooth_face", cm_smoothness_name(mapping->smooth_face), next);
    write_member(stream, "smooth_edge", edge_name(mapping), next);
    write_member(stream, "smooth_corner", corner_name(mapping), next);
    write_bounds(stream, &mapping->bounds);
    fputs(next, stream);
    fputs("\"fast\": ", stream);
    write_words(stream, fast_directions[mapping->fast & (CM_FAST_FORWARD | CM_FAST_INVERSE)]);
    fputs(next, stream);
    write_parameters(stream, mapping);
    fputs(next, stream);
    fputs("\"presets\": ", stream);
    write_words(stream, mapping->presets == NULL ? "" : mapping->presets);
    fputs("\n    }", stream);
}

/* "+x" for CM_AXIS_X. */
static void write_axis_member(FILE *stream, const char *key, int axis, const char *after)
{
    const int index = abs(axis) - CM_AXIS_X;
    fprintf(stream, "\"%s\": \"%c%c\"%s", key, axis < 0 ? '-' : '+',
            index >= 0 && index < 3 ? "xyz"[index] : '?', after);
}

static void write_frame_object(FILE *stream, const cm_frame *frame)
{
    fputs("    {\n      ", stream);
    write_member(stream, "identifier", frame->identifier, ",\n      ");
    write_member(stream, "name", frame->name, ",\n      ");
    fprintf(stream, "\"first_row_v\": %d,\n      \"faces\": [", frame->first_row_v);
    for (int face = 0; face < 6; face++)
    {
        fprintf(stream, "%s\n        {\"face\": %d, ", face == 0 ? "" : ",", face);
        write_member(stream, "name", frame->face[face].name, ", ");
        write_axis_member(stream, "outward", frame->face[face].outward, ", ");
        write_axis_member(stream, "u", frame->face[face].u, ", ");
        write_axis_member(stream, "v", frame->face[face].v, "}");
    }
    fputs("\n      ]\n    }", stream);
}

static void write_ellipsoid_members(FILE *stream, const cm_ellipsoid *ellipsoid)
{
    write_member(stream, "identifier", ellipsoid->identifier, ", ");
    write_member(stream, "name", ellipsoid->name, ", ");
    fprintf(stream, "\"a\": %.17g, \"f\": %.17g, ", ellipsoid->a, ellipsoid->f);
    write_member(stream, "source", ellipsoid->source, "}");
}

static void write_orientation_members(FILE *stream, const cm_orientation *orientation)
{
    write_member(stream, "identifier", orientation->identifier, ", ");
    write_member(stream, "name", orientation->name, ", ");
    write_member(stream, "mapping", orientation->mapping, ", ");
    write_member(stream, "measure", orientation->measure, ", ");
    fprintf(stream,
            "\"lon\": %.17g, \"lat\": %.17g, \"roll\": %.17g, \"before\": %.17g, "
            "\"after\": %.17g}",
            orientation->lon, orientation->lat, orientation->roll, orientation->before,
            orientation->after);
}

void listing_write_json(FILE *stream)
{
    fputs("{\n  ", stream);
    write_member(stream, "version", cm_version(), ",\n  ");
    write_member(stream, "recommended", CM_MAPPING_RECOMMENDED, ",\n  \"mappings\": [\n");
    for (size_t i = 0; i < cm_catalogue_count(); i++)
    {
        fputs(i == 0 ? "" : ",\n", stream);
        write_mapping_object(stream, cm_catalogue_at(i));
    }
    fputs("\n  ],\n  \"frames\": [\n", stream);
    for (size_t i = 0; i < cm_frame_count(); i++)
    {
        fputs(i == 0 ? "" : ",\n", stream);
        write_frame_object(stream, cm_frame_at(i));
    }
    fputs("\n  ],\n  \"ellipsoids\": [\n", stream);
    for (size_t i = 0; i < cm_ellipsoid_count(); i++)
    {
        fputs(i == 0 ? "    {" : ",\n    {", stream);
        write_ellipsoid_members(stream, cm_ellipsoid_at(i));
    }
    fputs("\n  ],\n  \"latitudes\": [", stream);
    for (int i = 0; i < CM_LATITUDE_COUNT; i++)
    {
        const char *const name = cm_latitude_name((cm_latitude)i);
        fputs(i == 0 ? "" : ", ", stream);
        write_text(stream, name, strlen(name));
    }
    fputs("],\n  \"orientations\": [\n", stream);
    for (size_t i = 0; i < cm_orientation_count(); i++)
    {
        fputs(i == 0 ? "    {" : ",\n    {", stream);
        write_orientation_members(stream, cm_orientation_at(i));
    }
    fputs("\n  ]\n}\n", stream);
}
