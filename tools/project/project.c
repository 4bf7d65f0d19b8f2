/* SPDX-License-Identifier: MIT
 *
 * cubemap-project: a filter for points. Reads lon lat or x y z, writes face u v, or for mappings of one
 * face u v or x y; -I inverts.
 */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <fcntl.h>
#include <getopt.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cubemap/cubemap.h>

#include "chain.h"
#include "tools/cli/command.h"
#include "tools/cli/failure.h"
#include "listing.h"
#include "point_filter.h"

typedef enum listing
{
    LISTING_NONE,
    LISTING_TABLE,
    LISTING_JSON
} listing;

struct settings
{
    struct chain_words words;
    const char *file; /* NULL for standard input */
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
    "      --frame FRAME       numbering and axes of the faces: geo, gl, fits or s2; default: geo\n"
    "      --ellipsoid E       LON LAT are geographic on it: WGS84, Moon... or A,1/F, the radius "
    "of\n"
    "                          the equator in metres and the inverse flattening; default: a "
    "sphere\n"
    "      --latitude NAME     of the mapping's sphere: geographic, geocentric, parametric,\n"
    "                          authalic, conformal, rectifying or authalic-approximation; "
    "default:\n"
    "                          conformal if the mapping is conformal, else authalic\n"
    "      --rotate LON,LAT[,ROLL]\n"
    "                          turn the cube, so that its front looks to LON,LAT in degrees, and "
    "by\n"
    "                          ROLL about that; or the name of an orientation, see --list\n"
    "      --cell LEVEL[:CURVE]\n"
    "                          instead of FACE U V the token of the cell of level 0 to 30, in the\n"
    "                          order of the curve hilbert (the default) or morton; -I gives "
    "centres\n"
    "      --healpix NSIDE[:ORDER]\n"
    "                          instead of FACE U V the HEALPix pixel, in the order ring (the "
    "default)\n"
    "                          or nest; -I gives centres\n"
    "  -I, --inverse           from faces, disc or square to the sphere, or from square to disc\n"
    "      --input FORM        what to read: lonlat (the default) or xyz, of any length\n"
    "      --output FORM       what -I writes: lonlat (the default) or xyz, of length 1\n"
    "      --float             compute in single precision\n"
    "      --digits N          write N significant digits, 1 to 17; default: 17, with --float 9\n"
    "      --list[=json]       print the mappings, frames, ellipsoids, latitudes and orientations, "
    "for\n"
    "                          people or for programs\n"
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
    "  " PROGRAM " -m quincuncial:stereographic,conformal points.txt\n"
    "  " PROGRAM " -m qsc --ellipsoid WGS84 --rotate land-edges --cell 12 points.txt\n"
    "  " PROGRAM " --healpix 1024:nest stars.txt\n";

static const struct option long_options[] = {
    {"mapping", required_argument, NULL, 'm'},  {"frame", required_argument, NULL, 'f'},
    {"inverse", no_argument, NULL, 'I'},        {"input", required_argument, NULL, 'i'},
    {"output", required_argument, NULL, 'o'},   {"float", no_argument, NULL, 's'},
    {"digits", required_argument, NULL, 'd'},   {"ellipsoid", required_argument, NULL, 'E'},
    {"latitude", required_argument, NULL, 'L'}, {"rotate", required_argument, NULL, 'R'},
    {"cell", required_argument, NULL, 'C'},     {"healpix", required_argument, NULL, 'H'},
    {"list", optional_argument, NULL, 'l'},     {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, 'V'},        {NULL, 0, NULL, 0},
};

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
        settings->words.mapping = optarg;
        break;
    case 'f':
        settings->words.frame = optarg;
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
    case 'E':
        settings->words.ellipsoid = optarg;
        break;
    case 'L':
        settings->words.latitude = optarg;
        break;
    case 'R':
        settings->words.rotation = optarg;
        break;
    case 'C':
        settings->words.cell = optarg;
        break;
    case 'H':
        settings->words.healpix = optarg;
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
    settings->file = parse_file(count, operand);
}

static struct settings parse_arguments(int argc, char **argv)
{
    struct settings settings = {.list = LISTING_NONE};
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":m:Ih", long_options, NULL)) != -1)
    {
        if (option == '?' || option == ':')
        {
            die_of_option(long_options, option, argv);
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
    settings.words.form = settings.input != NULL    ? "--input"
                          : settings.output != NULL ? "--output"
                                                    : NULL;
    settings.filter.xyz =
        parse_form("--input", settings.input) || parse_form("--output", settings.output);
    if (settings.filter.digits == 0)
    {
        settings.filter.digits = settings.filter.single ? 9 : CM_NUMBER_DIGITS;
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

int main(int argc, char **argv)
{
    struct settings settings = parse_arguments(argc, argv);
    if (settings.list != LISTING_NONE)
    {
        print_listing(settings.list);
    }
    struct chain chain = chain_create(&settings.words, settings.filter.single);
    settings.filter.grid = chain.grid;
    settings.filter.cells = chain.cells;
    settings.filter.level = chain.level;
    settings.filter.pixels = chain.pixels;
    const char *const name = settings.file != NULL ? settings.file : "<stdin>";
    const int descriptor = settings.file != NULL ? open(settings.file, O_RDONLY) : STDIN_FILENO;
    if (descriptor < 0)
    {
        die(EXIT_FAILURE, "cannot open %s: %s", name, strerror(errno));
    }
    const bool all_good = filter_points(&settings.filter, chain.mapping, descriptor, name);
    close_standard_output();
    chain_destroy(&chain);
    return all_good ? EXIT_SUCCESS : EXIT_FAILURE;
}
