/* SPDX-License-Identifier: MIT
 *
 * cubemap-latitude: a filter for latitudes. Reads one of an ellipsoid's latitudes a line, writes another.
 */
#include "cubemap_latitude.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/cubemap.h>

#include "latitude_filter.h"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/command.h"
#include "tools/cli/input_file.h"

static const char program[] = "cubemap-latitude";

struct settings
{
    const char *ellipsoid;
    const char *from;
    const char *to;   /* NULL until given */
    double tolerance; /* 0 for none */
    const char *file; /* NULL for standard input */
    bool exact;
    bool list;
    bool printed; /* is there nothing left to do? */
    struct latitude_options filter;
};

/* ------------------------------------------------------------------------------- options */

enum
{
    ELLIPSOID = 1,
    FROM,
    TO,
    RADIANS,
    TOLERANCE,
    EXACT,
    DIGITS,
    LIST
};

static const cm_option options[] = {
    {.id = ELLIPSOID,
     .letter = 'e',
     .name = "ellipsoid",
     .kind = CM_OPTION_TEXT,
     .argument = "ELLIPSOID",
     .help =
         "a name, as `WGS84` or `Mars`, or A,1/F, as `6378137,298.257223563`, the radius of the "
         "equator in metres and the inverse flattening",
     .more =
         "`6378137,1/298.257223563` is the same, and an inverse flattening of 0 a sphere. --list "
         "prints the names.",
     .standard = "`WGS84`",
     .choice_at = ellipsoid_name_at},
    {.id = FROM,
     .letter = 'f',
     .name = "from",
     .kind = CM_OPTION_TEXT,
     .argument = "LATITUDE",
     .help = "what is read",
     .standard = "`geographic`",
     .choice_at = latitude_name_at},
    {.id = TO,
     .letter = 't',
     .name = "to",
     .kind = CM_OPTION_TEXT,
     .argument = "LATITUDE",
     .help = "what is written",
     .choice_at = latitude_name_at},
    {.id = RADIANS, .name = "radians", .help = "read and write radians, not degrees"},
    {.id = TOLERANCE,
     .name = "tolerance",
     .kind = CM_OPTION_NUMBER,
     .argument = "T",
     .help =
         "take no more terms of the series than an error of T needs, in the unit of the latitudes",
     .more = "Double precision needs six on the Earth.",
     .standard = "full double precision",
     .low = 0.0,
     .high = HUGE_VAL,
     .flags = CM_OPTION_ABOVE},
    {.id = EXACT,
     .name = "exact",
     .help = "take closed forms, no series",
     .more =
         "They are taken anyway where the flattening is beyond 1/50, and are some hundred times "
         "slower."},
    {.id = DIGITS,
     .name = "digits",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "write N significant digits",
     .more = "17 bring back every number unchanged.",
     .standard = "17",
     .low = 1,
     .high = CM_NUMBER_DIGITS},
    {.id = LIST,
     .name = "list",
     .help = "print the latitudes, and the ellipsoids with their sources"},
};

static const cm_option_group groups[] = {{NULL, options, sizeof options / sizeof *options}};

const cm_command cm_latitude_command = {
    .name = program,
    .usage = "[OPTION]... --to LATITUDE [FILE]",
    .summary =
        "Convert between the latitudes of an ellipsoid: geographic, geocentric, parametric, "
        "authalic, conformal, rectifying, and authalic-approximation.\n\n"
        "Reads one latitude a line, in degrees, and writes another. What follows the number of a "
        "line, empty lines and lines that begin with # pass through. Without FILE, or when FILE is "
        "-, it reads standard input.",
    .groups = groups,
    .group_count = 1,
    .notes =
        "A line that is no latitude gives 'nan', a message that names the line, and exit status 1 "
        "at the end. Wrong usage gives exit status 2.\n\n"
        "Examples:\n"
        "  echo 41.9 Rome | cubemap-latitude --to authalic\n"
        "  cubemap-latitude --ellipsoid Mars --from geocentric --to geographic \\\n"
        "      <latitudes.txt\n"
        "  cubemap-latitude --ellipsoid 6378137,298.257223563 --to conformal --radians \\\n"
        "      latitudes.txt\n",
    .words = "A F",
    .operand = CM_OPTION_FILE};

static bool take_option(struct settings *settings, cm_option_reader *reader, int id,
                        cm_failure *failure)
{
    switch (id)
    {
    case ELLIPSOID:
        settings->ellipsoid = reader->text;
        break;
    case FROM:
        settings->from = reader->text;
        break;
    case TO:
        settings->to = reader->text;
        break;
    case RADIANS:
        settings->filter.radians = true;
        break;
    case TOLERANCE:
        settings->tolerance = reader->number;
        return !isinf(reader->number) ||
               check_usage(reader, cm_options_refuse(reader, "a number above 0"), failure);
    case EXACT:
        settings->exact = true;
        break;
    case DIGITS:
        settings->filter.digits = (int)reader->number;
        break;
    case LIST:
        settings->list = true;
        break;
    default:
        break;
    }
    return true;
}

static bool take_operands(struct settings *settings, int count, char **operand, cm_failure *failure)
{
    if (count > 0 && settings->list)
    {
        return fail(failure, EXIT_USAGE, "--list reads no file, but '%s' is given", operand[0]);
    }
    return take_file(count, operand, &settings->file, failure);
}

/* What the options mean together. */
static bool check_settings(const struct settings *settings, cm_failure *failure)
{
    if (settings->to == NULL && !settings->list)
    {
        return fail(failure, EXIT_USAGE, "--to is missing: the latitude to write; see --list");
    }
    if (settings->exact && settings->tolerance != 0.0)
    {
        return fail(failure, EXIT_USAGE,
                    "--tolerance has no meaning with --exact, which cuts nothing off");
    }
    return true;
}

static bool parse_arguments(struct settings *settings, int argc, char **argv,
                            const cm_streams *streams, cm_failure *failure)
{
    cm_option_reader reader = cm_options_begin(&cm_latitude_command, argc, argv, streams);
    int id;
    while ((id = cm_options_next(&reader)) > 0)
    {
        if (!take_option(settings, &reader, id, failure))
        {
            return false;
        }
    }
    settings->printed = id == CM_OPTIONS_PRINTED;
    return settings->printed ||
           (check_usage(&reader, id, failure) &&
            take_operands(settings, reader.operand_count, reader.operands, failure) &&
            check_settings(settings, failure));
}

/* ------------------------------------------------------------------------------- the list */

static void print_ellipsoid(FILE *stream, const cm_ellipsoid *ellipsoid)
{
    char inverse[CM_NUMBER_SIZE] = "";
    char radius[CM_NUMBER_SIZE];
    cm_number_write(ellipsoid->a, CM_NUMBER_DIGITS - 4, radius);
    if (ellipsoid->f == 0.0)
    {
        snprintf(inverse, sizeof inverse, "sphere");
    }
    else
    {
        cm_number_write(1.0 / ellipsoid->f, 12, inverse);
    }
    fprintf(stream, "%-20s %12s  %-14s %s; %s\n", ellipsoid->identifier, radius, inverse,
            ellipsoid->name, ellipsoid->source);
}

static void print_list(FILE *stream)
{
    fprintf(stream, "Latitudes:\n");
    for (int i = 0; i < CM_LATITUDE_COUNT; i++)
    {
        fprintf(stream, "%s\n", cm_latitude_name((cm_latitude)i));
    }
    fprintf(stream,
            "\nEllipsoids: name, equatorial radius in metres, inverse flattening; source\n");
    for (size_t i = 0; i < cm_ellipsoid_count(); i++)
    {
        print_ellipsoid(stream, cm_ellipsoid_at(i));
    }
}

/* ------------------------------------------------------------------------------- program */

static bool take_ellipsoid(const char *text, cm_ellipsoid *ellipsoid, cm_failure *failure)
{
    char message[256];
    const cm_nearest nearest = nearest_name(text, ellipsoid_name_at);
    if (cm_ellipsoid_parse(text, ellipsoid, message, sizeof message) == CM_OK)
    {
        return true;
    }
    if (nearest.best == NULL)
    {
        return fail(failure, EXIT_USAGE, "--ellipsoid: %s; see --list", message);
    }
    return fail_nearest(failure, &nearest, "--ellipsoid: %s", message);
}

static bool create_conversion(const struct settings *settings, const cm_ellipsoid *ellipsoid,
                              cm_latitude_conversion **conversion, cm_failure *failure)
{
    const double degree = 0.017453292519943295;
    char message[256];
    const double unit = settings->filter.radians ? 1.0 : degree;
    const cm_latitude_options series = {
        .size = sizeof series, .tolerance = settings->tolerance * unit, .exact = settings->exact};
    cm_latitude from;
    cm_latitude to;
    if (!take_latitude("--from", settings->from, &from, failure) ||
        !take_latitude("--to", settings->to, &to, failure))
    {
        return false;
    }
    if (cm_instructions_check(NULL, message, sizeof message) != CM_OK)
    {
        return fail(failure, EXIT_FAILURE, "%s", message);
    }
    const cm_status status =
        cm_latitude_conversion_create(ellipsoid, from, to, &series, conversion);
    return status == CM_OK || fail(failure, EXIT_FAILURE, "%s to %s: %s", settings->from,
                                   settings->to, cm_status_text(status));
}

static bool convert(const struct settings *settings, const cm_streams *streams, cm_failure *failure)
{
    cm_ellipsoid ellipsoid;
    cm_latitude_conversion *conversion = NULL;
    bool all_good = false;
    if (take_ellipsoid(settings->ellipsoid, &ellipsoid, failure) &&
        create_conversion(settings, &ellipsoid, &conversion, failure))
    {
        const bool has_file = settings->file != NULL;
        FILE *const in = has_file ? open_input(settings->file, failure) : streams->in;
        const cm_streams files = {in, streams->out, streams->err};
        all_good = in != NULL && filter_latitudes(&settings->filter, &ellipsoid, conversion, &files,
                                                  has_file ? settings->file : "<stdin>", failure);
        if (has_file && in != NULL)
        {
            fclose(in);
        }
    }
    cm_latitude_conversion_destroy(conversion);
    return all_good;
}

static bool run(const struct settings *settings, const cm_streams *streams, cm_failure *failure)
{
    if (settings->printed)
    {
        return true;
    }
    if (settings->list)
    {
        print_list(streams->out);
        return true;
    }
    return convert(settings, streams, failure);
}

int cm_latitude_main(int argc, char **argv, const cm_streams *streams)
{
    struct settings settings = {
        .ellipsoid = "WGS84", .from = "geographic", .filter = {.digits = CM_NUMBER_DIGITS}};
    cm_failure failure = {.status = 0};
    const bool good = parse_arguments(&settings, argc, argv, streams, &failure) &&
                      run(&settings, streams, &failure);
    return end_program(program, streams, &failure, good ? EXIT_SUCCESS : EXIT_FAILURE);
}
