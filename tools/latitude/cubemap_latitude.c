/* SPDX-License-Identifier: MIT
 *
 * cubemap-latitude: a filter for latitudes. Reads one of an ellipsoid's latitudes a line, writes another.
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

#include "tools/cli/command.h"
#include "tools/cli/failure.h"
#include "latitude_filter.h"

struct settings
{
    const char *ellipsoid;
    const char *from;
    const char *to;        /* NULL until given */
    const char *tolerance; /* NULL for none */
    const char *file;      /* NULL for standard input */
    bool exact;
    bool list;
    struct latitude_options filter;
};

static const char usage_text[] =
    "Usage: " PROGRAM " [OPTION...] --to LATITUDE [FILE]\n"
    "Convert between the latitudes of an ellipsoid: geographic, geocentric, parametric, authalic,\n"
    "conformal, rectifying, and authalic-approximation.\n"
    "\n"
    "Reads one latitude a line, in degrees, and writes another. What follows the number of a "
    "line,\n"
    "empty lines and lines that begin with # pass through. Without FILE, or when FILE is -, it\n"
    "reads standard input.\n"
    "\n"
    "  -e, --ellipsoid ELLIPSOID  a name, as WGS84 or Mars, or A,1/F, as 6378137,298.257223563,\n"
    "                             the radius and the inverse flattening; default: WGS84\n"
    "  -f, --from LATITUDE        what is read; default: geographic\n"
    "  -t, --to LATITUDE          what is written\n"
    "      --radians              read and write radians\n"
    "      --tolerance T          take no more terms of the series than an error of T needs, in "
    "the\n"
    "                             unit of the latitudes; default: full double precision\n"
    "      --exact                take closed forms, no series\n"
    "      --digits N             write N significant digits, 1 to 17; default: 17\n"
    "      --list                 print the ellipsoids and the latitudes\n"
    "  -h, --help                 print this help\n"
    "      --version              print the version\n"
    "\n"
    "A line that is no latitude gives 'nan', a message that names the line, and exit status 1 at\n"
    "the end. Wrong usage gives exit status 2.\n"
    "\n"
    "Examples:\n"
    "  echo 41.9 Rome | " PROGRAM " --to authalic\n"
    "  " PROGRAM " --ellipsoid Mars --from geocentric --to geographic <latitudes.txt\n"
    "  " PROGRAM " --ellipsoid 6378137,298.257223563 --to conformal --radians latitudes.txt\n";

static const struct option long_options[] = {
    {"ellipsoid", required_argument, NULL, 'e'},
    {"from", required_argument, NULL, 'f'},
    {"to", required_argument, NULL, 't'},
    {"radians", no_argument, NULL, 'r'},
    {"tolerance", required_argument, NULL, 'T'},
    {"exact", no_argument, NULL, 'x'},
    {"digits", required_argument, NULL, 'd'},
    {"list", no_argument, NULL, 'l'},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, 'V'},
    {NULL, 0, NULL, 0},
};

static void take_option(struct settings *settings, int option)
{
    switch (option)
    {
    case 'e':
        settings->ellipsoid = optarg;
        break;
    case 'f':
        settings->from = optarg;
        break;
    case 't':
        settings->to = optarg;
        break;
    case 'r':
        settings->filter.radians = true;
        break;
    case 'T':
        settings->tolerance = optarg;
        break;
    case 'x':
        settings->exact = true;
        break;
    case 'd':
        settings->filter.digits = parse_digits(optarg);
        break;
    case 'l':
        settings->list = true;
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

static void take_operands(struct settings *settings, int count, char **operand)
{
    if (count > 0 && settings->list)
    {
        die(EXIT_USAGE, "--list reads no file, but '%s' is given", operand[0]);
    }
    settings->file = parse_file(count, operand);
}

static struct settings parse_arguments(int argc, char **argv)
{
    struct settings settings = {
        .ellipsoid = "WGS84", .from = "geographic", .filter = {.digits = CM_NUMBER_DIGITS}};
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":e:f:t:h", long_options, NULL)) != -1)
    {
        if (option == '?' || option == ':')
        {
            die_of_option(long_options, option, argv);
        }
        take_option(&settings, option);
    }
    take_operands(&settings, argc - optind, argv + optind);
    if (settings.to == NULL && !settings.list)
    {
        die(EXIT_USAGE, "--to is missing: the latitude to write; see --list");
    }
    if (settings.exact && settings.tolerance != NULL)
    {
        die(EXIT_USAGE, "--tolerance has no meaning with --exact, which cuts nothing off");
    }
    return settings;
}

/* ------------------------------------------------------------------------------- the list */

static void print_ellipsoid(const cm_ellipsoid *ellipsoid)
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
    printf("%-20s %12s  %-14s %s; %s\n", ellipsoid->identifier, radius, inverse, ellipsoid->name,
           ellipsoid->source);
}

_Noreturn static void print_list(void)
{
    printf("Latitudes:\n");
    for (int i = 0; i < CM_LATITUDE_COUNT; i++)
    {
        printf("%s\n", cm_latitude_name((cm_latitude)i));
    }
    printf("\nEllipsoids: name, equatorial radius in metres, inverse flattening; source\n");
    for (size_t i = 0; i < cm_ellipsoid_count(); i++)
    {
        print_ellipsoid(cm_ellipsoid_at(i));
    }
    print_and_exit("");
}

/* ------------------------------------------------------------------------------- main */

/* In radians; 0 for none. */
static double find_tolerance(const struct settings *settings)
{
    const double degree = 0.017453292519943295;
    double value;
    if (settings->tolerance == NULL)
    {
        return 0.0;
    }
    if (!cm_number_parse(settings->tolerance, strlen(settings->tolerance), &value) || !(value > 0.0) || isinf(value))
    {
        die(EXIT_USAGE, "--tolerance is '%s', not a number above 0", settings->tolerance);
    }
    return settings->filter.radians ? value : value * degree;
}

static cm_latitude_conversion *create_conversion(const struct settings *settings,
                                                 const cm_ellipsoid *ellipsoid)
{
    char message[256];
    const cm_latitude_options options = {
        .size = sizeof options, .tolerance = find_tolerance(settings), .exact = settings->exact};
    const cm_latitude from = parse_latitude("--from", settings->from);
    const cm_latitude to = parse_latitude("--to", settings->to);
    cm_latitude_conversion *conversion = NULL;
    if (cm_instructions_check(NULL, message, sizeof message) != CM_OK)
    {
        die(EXIT_FAILURE, "%s", message);
    }
    const cm_status status =
        cm_latitude_conversion_create(ellipsoid, from, to, &options, &conversion);
    if (status != CM_OK)
    {
        die(EXIT_FAILURE, "%s to %s: %s", settings->from, settings->to, cm_status_text(status));
    }
    return conversion;
}

int main(int argc, char **argv)
{
    const struct settings settings = parse_arguments(argc, argv);
    char message[256];
    cm_ellipsoid ellipsoid;
    if (settings.list)
    {
        print_list();
    }
    if (cm_ellipsoid_parse(settings.ellipsoid, &ellipsoid, message, sizeof message) != CM_OK)
    {
        die(EXIT_USAGE, "--ellipsoid: %s; see --list", message);
    }
    cm_latitude_conversion *const conversion = create_conversion(&settings, &ellipsoid);
    const char *const name = settings.file != NULL ? settings.file : "<stdin>";
    const int descriptor = settings.file != NULL ? open(settings.file, O_RDONLY) : STDIN_FILENO;
    if (descriptor < 0)
    {
        die(EXIT_FAILURE, "cannot open %s: %s", name, strerror(errno));
    }
    const bool all_good =
        filter_latitudes(&settings.filter, &ellipsoid, conversion, descriptor, name);
    close_standard_output();
    cm_latitude_conversion_destroy(conversion);
    return all_good ? EXIT_SUCCESS : EXIT_FAILURE;
}
