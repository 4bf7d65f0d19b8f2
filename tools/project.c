/* SPDX-License-Identifier: MIT
 *
 * cubemap-project: a filter for points. Reads lon lat or x y z, writes face u v, or for mappings of one
 * face u v or x y; -I inverts.
 */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <fcntl.h>
#include <getopt.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cubemap/cubemap.h>

#include "failure.h"
#include "listing.h"
#include "number.h"
#include "point_filter.h"

typedef enum listing
{
    LISTING_NONE,
    LISTING_TABLE,
    LISTING_JSON
} listing;

struct settings
{
    const char *mapping;
    const char *frame; /* NULL if none is given */
    const char *file;  /* NULL for standard input */
    const char *input;
    const char *output;
    struct filter_options filter; /* digits is 0 until known */
    listing list;
};

/* ------------------------------------------------------------------------------- options */

static const char usage_text[] =
    "Usage: " PROGRAM " [OPTION...] [FILE]\n"
    "Project points from the sphere to the six faces of a cube, to a disc or to a square, or "
    "back.\n"
    "\n"
    "Reads lines 'LON LAT' in degrees and writes lines 'FACE U V', FACE from 0 to 5, U and V\n"
    "from -1 to 1; with -I reads 'FACE U V' and writes 'LON LAT'. Mappings of one face have none\n"
    "to write: what is on the plane is 'U V' for azimuthal ones, which map to the unit disc, and\n"
    "'X Y' for layouts, which map to one square; square:NAME maps the disc's 'U V' to the\n"
    "square's 'X Y'. What follows the numbers of a line, empty lines and lines that begin with #\n"
    "pass through. Without FILE, or when FILE is -, it reads standard input.\n"
    "\n"
    "  -m, --mapping MAPPING   NAME, NAME:PRESET or NAME:PARAMETER=VALUE[,...]; "
    "default: " CM_MAPPING_RECOMMENDED "\n"
    "      --frame FRAME       numbering and axes of the faces: geo, gl or fits; default: geo\n"
    "  -I, --inverse           from faces, disc or square to the sphere, or from square to disc\n"
    "      --input FORM        what to read: lonlat (the default) or xyz, of any length\n"
    "      --output FORM       what -I writes: lonlat (the default) or xyz, of length 1\n"
    "      --float             compute in single precision\n"
    "      --digits N          write N significant digits, 1 to 17; default: 17, with --float 9\n"
    "      --list[=json]       print the mappings and frames, for people or for programs\n"
    "  -h, --help              print this help\n"
    "      --version           print the version\n"
    "\n"
    "A line that is no point, or none of the map, gives 'nan' for each number, a message that\n"
    "names the line, and exit status 1 at the end. Wrong usage gives exit status 2.\n"
    "\n"
    "Examples:\n"
    "  echo 12.5 41.9 Rome | " PROGRAM "\n"
    "  " PROGRAM " -m tangent:c=1.1823 --frame gl points.txt >faces.txt\n"
    "  " PROGRAM " -m azimuthal:equidistant:fov=220,lon=10,lat=50 points.txt\n"
    "  " PROGRAM " -m quincuncial:stereographic,conformal points.txt\n";

static const struct option long_options[] = {
    {"mapping", required_argument, NULL, 'm'},
    {"frame", required_argument, NULL, 'f'},
    {"inverse", no_argument, NULL, 'I'},
    {"input", required_argument, NULL, 'i'},
    {"output", required_argument, NULL, 'o'},
    {"float", no_argument, NULL, 's'},
    {"digits", required_argument, NULL, 'd'},
    {"list", optional_argument, NULL, 'l'},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, 'V'},
    {NULL, 0, NULL, 0},
};

static const char *long_name(int value)
{
    for (const struct option *option = long_options; option->name != NULL; option++)
    {
        if (option->val == value)
        {
            return option->name;
        }
    }
    return "?";
}

/* What getopt_long reports without words: result is '?' or ':', optopt and optind are its own. */
_Noreturn static void die_of_option(int result, char **argv)
{
    const char *const argument = argv[optind - 1];
    const char *const help = "; see " PROGRAM " --help";
    if (result == ':')
    {
        die(EXIT_USAGE, "--%s needs an argument%s", long_name(optopt), help);
    }
    if (optopt != 0 && strncmp(argument, "--", 2) == 0)
    {
        die(EXIT_USAGE, "--%s takes no argument%s", long_name(optopt), help);
    }
    if (optopt != 0)
    {
        die(EXIT_USAGE, "there is no option -%c%s", optopt, help);
    }
    die(EXIT_USAGE, "there is no option %s, or it is short for several%s", argument, help);
}

static void close_standard_output(void)
{
    if (fflush(stdout) != 0 || ferror(stdout) != 0 || close(STDOUT_FILENO) != 0)
    {
        die(EXIT_FAILURE, "cannot write to standard output: %s", strerror(errno));
    }
}

_Noreturn static void print_and_exit(const char *text)
{
    fputs(text, stdout);
    close_standard_output();
    exit(EXIT_SUCCESS);
}

static int parse_digits(const char *text)
{
    double value;
    const char *const end = text + strlen(text);
    if (number_read(text, end, &value) != end || !(value >= 1 && value <= NUMBER_DIGITS_MAX) ||
        value != floor(value))
    {
        die(EXIT_USAGE, "--digits is '%s', not a whole number from 1 to %d", text,
            NUMBER_DIGITS_MAX);
    }
    return (int)value;
}

static listing parse_listing(const char *form)
{
    if (form != NULL && strcmp(form, "json") != 0)
    {
        die(EXIT_USAGE, "--list is '%s': it is --list or --list=json", form);
    }
    return form != NULL ? LISTING_JSON : LISTING_TABLE;
}

static void take_option(struct settings *settings, int option)
{
    switch (option)
    {
    case 'm':
        settings->mapping = optarg;
        break;
    case 'f':
        settings->frame = optarg;
        break;
    case 'I':
        settings->filter.inverse = true;
        break;
    case 'i':
        settings->input = optarg;
        break;
    case 'o':
        settings->output = optarg;
        break;
    case 's':
        settings->filter.single = true;
        break;
    case 'd':
        settings->filter.digits = parse_digits(optarg);
        break;
    case 'l':
        settings->list = parse_listing(optarg);
        break;
    case 'h':
        print_and_exit(usage_text);
    case 'V':
        printf(PROGRAM " (libcubemap) %s\n", cm_version());
        print_and_exit("");
    default:
        break;
    }
}

/* lonlat or xyz? */
static bool parse_form(const char *option, const char *form)
{
    if (form != NULL && strcmp(form, "lonlat") != 0 && strcmp(form, "xyz") != 0)
    {
        die(EXIT_USAGE, "%s is '%s', not lonlat or xyz", option, form);
    }
    return form != NULL && strcmp(form, "xyz") == 0;
}

static void take_operands(struct settings *settings, int count, char **operand)
{
    if (count > 0 && settings->list != LISTING_NONE)
    {
        die(EXIT_USAGE, "--list reads no file, but '%s' is given (--list=json has no blank)",
            operand[0]);
    }
    if (count > 1)
    {
        die(EXIT_USAGE, "one FILE at most, but '%s' follows '%s'", operand[1], operand[0]);
    }
    if (count == 1 && strcmp(operand[0], "-") != 0)
    {
        settings->file = operand[0];
    }
}

static struct settings parse_arguments(int argc, char **argv)
{
    struct settings settings = {.mapping = CM_MAPPING_RECOMMENDED};
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":m:Ih", long_options, NULL)) != -1)
    {
        if (option == '?' || option == ':')
        {
            die_of_option(option, argv);
        }
        take_option(&settings, option);
    }
    take_operands(&settings, argc - optind, argv + optind);
    if (settings.filter.inverse && settings.input != NULL)
    {
        die(EXIT_USAGE, "--input has no meaning with -I, which reads points of the plane");
    }
    if (!settings.filter.inverse && settings.output != NULL)
    {
        die(EXIT_USAGE, "--output has no meaning without -I: points of the plane are written");
    }
    settings.filter.xyz =
        parse_form("--input", settings.input) || parse_form("--output", settings.output);
    if (settings.filter.digits == 0)
    {
        settings.filter.digits = settings.filter.single ? 9 : NUMBER_DIGITS_MAX;
    }
    return settings;
}

/* ------------------------------------------------------------------------------- main */

_Noreturn static void print_listing(listing form)
{
    if (form == LISTING_JSON)
    {
        listing_write_json(stdout);
    }
    else
    {
        listing_write_table(stdout);
    }
    print_and_exit("");
}

static const cm_frame *find_frame(const char *identifier)
{
    const cm_frame *const frame = cm_frame_find(identifier);
    if (frame == NULL)
    {
        char known[256] = "";
        for (size_t i = 0; i < cm_frame_count(); i++)
        {
            const size_t length = strlen(known);
            snprintf(known + length, sizeof known - length, "%s%s", i == 0 ? "" : ", ",
                     cm_frame_at(i)->identifier);
        }
        die(EXIT_USAGE, "--frame is '%s', not one of %s", identifier, known);
    }
    return frame;
}

static cm_mapping *create_mapping(const struct settings *settings)
{
    char message[256];
    cm_mapping *mapping = NULL;
    const cm_frame *const frame = find_frame(settings->frame != NULL ? settings->frame : "geo");
    if (cm_specification_check(settings->mapping, message, sizeof message) != CM_OK)
    {
        die(EXIT_USAGE, "-m %s: %s; see --list", settings->mapping, message);
    }
    if (cm_instructions_check(NULL, message, sizeof message) != CM_OK)
    {
        die(EXIT_FAILURE, "%s", message);
    }
    const cm_status status = cm_mapping_create(settings->mapping, frame, &mapping);
    if (status != CM_OK)
    {
        die(EXIT_FAILURE, "-m %s: %s", settings->mapping, cm_status_text(status));
    }
    return mapping;
}

/* Options that mean nothing for mappings of this kind. */
static void check_options(const struct settings *settings, cm_mapping *mapping)
{
    const cm_kind kind = cm_mapping_describe(mapping)->kind;
    const char *const form = settings->input != NULL    ? "--input"
                             : settings->output != NULL ? "--output"
                                                        : NULL;
    if (kind != CM_KIND_CUBE && settings->frame != NULL)
    {
        cm_mapping_destroy(mapping);
        die(EXIT_USAGE, "--frame has no meaning with -m %s, which has one face", settings->mapping);
    }
    if (kind == CM_KIND_DISC_SQUARE && form != NULL)
    {
        cm_mapping_destroy(mapping);
        die(EXIT_USAGE, "%s has no meaning with -m %s, which joins disc and square, not the sphere",
            form, settings->mapping);
    }
}

int main(int argc, char **argv)
{
    const struct settings settings = parse_arguments(argc, argv);
    if (settings.list != LISTING_NONE)
    {
        print_listing(settings.list);
    }
    cm_mapping *const mapping = create_mapping(&settings);
    check_options(&settings, mapping);
    const char *const name = settings.file != NULL ? settings.file : "<stdin>";
    const int descriptor = settings.file != NULL ? open(settings.file, O_RDONLY) : STDIN_FILENO;
    if (descriptor < 0)
    {
        die(EXIT_FAILURE, "cannot open %s: %s", name, strerror(errno));
    }
    const bool all_good = filter_points(&settings.filter, mapping, descriptor, name);
    close_standard_output();
    cm_mapping_destroy(mapping);
    return all_good ? EXIT_SUCCESS : EXIT_FAILURE;
}
