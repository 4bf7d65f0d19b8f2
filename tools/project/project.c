/* SPDX-License-Identifier: MIT
 *
 * cubemap-project: a filter for points. Reads lon lat or x y z, writes face u v, or for mappings of one
 * face u v or x y; -I inverts.
 */
#include "project.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/cubemap.h>

#include "chain.h"
#include "tools/cli/catalogue_name.h"
#include "tools/cli/command.h"
#include "tools/cli/input_file.h"
#include "listing.h"
#include "point_filter.h"

static const char program[] = "cubemap-project";

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
    bool printed; /* is there nothing left to do? */
};

/* ------------------------------------------------------------------------------- options */

enum
{
    MAPPING = 1,
    FRAME,
    ELLIPSOID,
    LATITUDE,
    ROTATE,
    CELL,
    HEALPIX,
    INVERSE,
    INPUT,
    OUTPUT,
    FLOAT,
    DIGITS,
    LIST
};

static const char *const direction_forms[] = {"lonlat", "xyz", NULL};
static const char *const list_forms[] = {"json", NULL};

static const cm_option options[] = {
    {.id = MAPPING,
     .letter = 'm',
     .name = "mapping",
     .kind = CM_OPTION_TEXT,
     .argument = "MAPPING",
     .help = "the mapping between sphere and faces, disc or square, as NAME, NAME:PRESET or "
             "NAME:PARAMETER=VALUE[,...]",
     .more =
         "For example `algebraic`, `difference:mild`, `tangent:c=1.1823` or "
         "`azimuthal:equidistant:fov=220,lon=10,lat=50`. Presets are names for values of all the "
         "parameters. --list prints the names, of which `" CM_MAPPING_RECOMMENDED
         "` is the recommended one.",
     .standard = "`" CM_MAPPING_RECOMMENDED "`",
     .choice_at = mapping_name_at},
    {.id = FRAME,
     .name = "frame",
     .kind = CM_OPTION_TEXT,
     .argument = "FRAME",
     .help = "numbering and axes of the faces: `geo`, `gl`, `fits` or `s2`",
     .more =
         "`geo` is front, right, back, left, top, bottom; `gl` the cube map of OpenGL, Vulkan "
         "and Direct3D; `fits` that of FITS WCS paper II; `s2` has the faces of the S2 library. "
         "Only for mappings to six faces.",
     .standard = "`geo`",
     .choice_at = frame_name_at},
    {.id = ELLIPSOID,
     .name = "ellipsoid",
     .kind = CM_OPTION_TEXT,
     .argument = "ELLIPSOID",
     .help = "LON LAT are geographic coordinates on this ellipsoid, X Y Z its normals: `WGS84`, "
             "`Moon` or another name of --list, or A,1/F, the radius of the equator in metres and "
             "the inverse flattening",
     .more = "As `6378137,298.257223563`; an inverse flattening of 0 is a sphere.",
     .standard = "a sphere",
     .choice_at = ellipsoid_name_at},
    {.id = LATITUDE,
     .name = "latitude",
     .kind = CM_OPTION_TEXT,
     .argument = "LATITUDE",
     .help = "the auxiliary latitude that makes a sphere of the ellipsoid: `geographic`, "
             "`geocentric`, `parametric`, `authalic`, `conformal`, `rectifying` or "
             "`authalic-approximation`",
     .more =
         "With the conformal one a conformal mapping stays conformal on the ellipsoid; with the "
         "authalic one equal-area mappings keep areas. Without --ellipsoid it is one of WGS84.",
     .standard = "conformal if the mapping is conformal, else authalic",
     .choice_at = latitude_name_at},
    {.id = ROTATE,
     .name = "rotate",
     .kind = CM_OPTION_TEXT,
     .argument = "LON,LAT[,ROLL]",
     .help = "turn the cube, disc or square, so that its front looks to LON,LAT in degrees, and by "
             "ROLL about that; or the name of an orientation, see --list",
     .more =
         "LON and LAT are in the mapping's sphere, where the front is +x; ROLL is anticlockwise "
         "seen from outside. The orientations that have a name suit the land; `cubemap-orient` "
         "finds others.",
     .choice_at = orientation_name_at},
    {.id = CELL,
     .name = "cell",
     .kind = CM_OPTION_TEXT,
     .argument = "LEVEL[:CURVE]",
     .help =
         "instead of FACE U V the token of the cell of level 0 to 30, in the order of the curve "
         "`hilbert` (the default), `morton` or `s2`; -I gives centres",
     .more =
         "Level 0 is a face, level 30 some 9 mm. With -I it reads tokens, of any level. With `-m "
         "s2 --frame s2` and the curve `s2`, which is Hilbert's, the tokens are those of the S2 "
         "library "
         "for every point; with `hilbert` a point on an edge of cells may be in the next one."},
    {.id = HEALPIX,
     .name = "healpix",
     .kind = CM_OPTION_TEXT,
     .argument = "NSIDE[:ORDER]",
     .help = "instead of FACE U V the number of the HEALPix pixel, in the order `ring` (the "
             "default) or `nest`; -I gives centres",
     .more =
         "NSIDE is from 1 to 536870912, in the order `nest` a power of two. LON is HEALPix's: 0 "
         "is on the edge of its base pixels."},
    {.id = INVERSE,
     .letter = 'I',
     .name = "inverse",
     .help = "from faces, disc or square to the sphere, or from square to disc"},
    {.id = INPUT,
     .name = "input",
     .kind = CM_OPTION_CHOICE,
     .argument = "FORM",
     .help = "what to read: `lonlat`, in degrees, or `xyz`, of any length",
     .more = "Neither with -I nor with `square:`.",
     .standard = "`lonlat`",
     .choices = direction_forms,
     .flags = CM_OPTION_TOLD},
    {.id = OUTPUT,
     .name = "output",
     .kind = CM_OPTION_CHOICE,
     .argument = "FORM",
     .help = "what to write with -I: `lonlat`, in degrees, or `xyz`, of length 1",
     .more = "Not with `square:`.",
     .standard = "`lonlat`",
     .choices = direction_forms,
     .flags = CM_OPTION_TOLD},
    {.id = FLOAT,
     .name = "float",
     .help = "compute in single precision",
     .more = "Longitudes and latitudes are still converted in double precision."},
    {.id = DIGITS,
     .name = "digits",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "write N significant digits",
     .more = "17 bring back every number unchanged; 9 do so for single precision.",
     .standard = "17, with --float 9",
     .low = 1,
     .high = CM_NUMBER_DIGITS},
    {.id = LIST,
     .name = "list",
     .kind = CM_OPTION_TEXT,
     .argument = "json",
     .help =
         "print the mappings, frames, ellipsoids, latitudes and orientations, for people or for "
         "programs",
     .more =
         "Mappings come with their properties, parameters and sources; as JSON, with the bounds "
         "on their errors, too.",
     .choices = list_forms,
     .flags = CM_OPTION_OPTIONAL},
};

static const cm_option_group groups[] = {{NULL, options, sizeof options / sizeof *options}};

const cm_command cm_project_command = {
    .name = program,
    .usage = "[OPTION]... [FILE]",
    .summary =
        "Project points from the sphere to the six faces of a cube, to a disc or to a square, or "
        "back.\n\n"
        "Reads lines 'LON LAT' in degrees and writes lines 'FACE U V', FACE from 0 to 5, U and V "
        "from -1 to 1; with -I reads 'FACE U V' and writes 'LON LAT'. Mappings of one face have "
        "none to write: what is on the plane is 'U V' for azimuthal ones, which map to the unit "
        "disc, and 'X Y' for layouts, which map to one square; square:NAME maps the disc's 'U V' "
        "to the square's 'X Y'. What follows the numbers of a line, empty lines and lines that "
        "begin with # pass through. Without FILE, or when FILE is -, it reads standard input.",
    .groups = groups,
    .group_count = 1,
    .notes =
        "A line that is no point, or none of the map, gives 'nan' for each number, a message that "
        "names the line, and exit status 1 at the end. Wrong usage gives exit status 2.\n\n"
        "Examples:\n"
        "  echo 12.5 41.9 Rome | cubemap-project\n"
        "  cubemap-project -m tangent:c=1.1823 --frame gl points.txt >faces.txt\n"
        "  cubemap-project -m azimuthal:equidistant:fov=220,lon=10,lat=50 points.txt\n"
        "  cubemap-project -m quincuncial:stereographic,conformal points.txt\n"
        "  cubemap-project -m qsc --ellipsoid WGS84 --rotate land-edges --cell 12 \\\n"
        "      points.txt\n"
        "  cubemap-project --healpix 1024:nest stars.txt\n",
    .words = "LON LAT X Y Z FACE U V NAME PRESET PARAMETER VALUE A F",
    .operand = CM_OPTION_FILE};

static bool take_listing(const char *form, listing *list, cm_failure *failure)
{
    if (form != NULL && strcmp(form, "json") != 0)
    {
        return fail(failure, EXIT_USAGE, "--list is '%s': it is --list or --list=json", form);
    }
    *list = form != NULL ? LISTING_JSON : LISTING_TABLE;
    return true;
}

/* Where the text of an option goes that is looked at later. */
static const char **word_of(struct settings *settings, int id)
{
    struct chain_words *const words = &settings->words;
    switch (id)
    {
    case MAPPING:
        return &words->mapping;
    case FRAME:
        return &words->frame;
    case ELLIPSOID:
        return &words->ellipsoid;
    case LATITUDE:
        return &words->latitude;
    case ROTATE:
        return &words->rotation;
    case CELL:
        return &words->cell;
    case HEALPIX:
        return &words->healpix;
    case INPUT:
        return &settings->input;
    case OUTPUT:
        return &settings->output;
    default:
        return NULL;
    }
}

static bool take_option(struct settings *settings, const cm_option_reader *reader, int id,
                        cm_failure *failure)
{
    switch (id)
    {
    case INVERSE:
        settings->filter.inverse = true;
        return true;
    case FLOAT:
        settings->filter.single = true;
        return true;
    case DIGITS:
        settings->filter.digits = (int)reader->number;
        return true;
    case LIST:
        return take_listing(reader->text, &settings->list, failure);
    default:
        *word_of(settings, id) = reader->text;
        return true;
    }
}

static bool take_operands(struct settings *settings, int count, char **operand, cm_failure *failure)
{
    if (count > 0 && settings->list != LISTING_NONE)
    {
        return fail(failure, EXIT_USAGE,
                    "--list reads no file, but '%s' is given (--list=json has no blank)",
                    operand[0]);
    }
    return take_file(count, operand, &settings->file, failure);
}

/* What the options mean together. */
static bool complete_settings(struct settings *settings, cm_failure *failure)
{
    if (settings->filter.inverse && settings->input != NULL)
    {
        return fail(failure, EXIT_USAGE,
                    "--input has no meaning with -I, which reads points of the plane");
    }
    if (!settings->filter.inverse && settings->output != NULL)
    {
        return fail(failure, EXIT_USAGE,
                    "--output has no meaning without -I: points of the plane are written");
    }
    const char *const form = settings->input != NULL ? settings->input : settings->output;
    settings->words.form = settings->input != NULL    ? "--input"
                           : settings->output != NULL ? "--output"
                                                      : NULL;
    settings->filter.xyz = form != NULL && strcmp(form, "xyz") == 0;
    if (settings->filter.digits == 0)
    {
        settings->filter.digits = settings->filter.single ? 9 : CM_NUMBER_DIGITS;
    }
    return true;
}

static bool parse_arguments(struct settings *settings, int argc, char **argv,
                            const cm_streams *streams, cm_failure *failure)
{
    cm_option_reader reader = cm_options_begin(&cm_project_command, argc, argv, streams);
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
            complete_settings(settings, failure));
}

/* ------------------------------------------------------------------------------- program */

static bool project(struct settings *settings, const cm_streams *streams, cm_failure *failure)
{
    struct chain chain = {.mapping = NULL};
    bool all_good = false;
    if (chain_create(&settings->words, settings->filter.single, &chain, failure))
    {
        settings->filter.grid = chain.grid;
        settings->filter.cells = chain.cells;
        settings->filter.level = chain.level;
        settings->filter.pixels = chain.pixels;
        const bool has_file = settings->file != NULL;
        FILE *const in = has_file ? open_input(settings->file, failure) : streams->in;
        const cm_streams files = {in, streams->out, streams->err};
        all_good = in != NULL && filter_points(&settings->filter, chain.mapping, &files,
                                               has_file ? settings->file : "<stdin>", failure);
        if (has_file && in != NULL)
        {
            fclose(in);
        }
    }
    chain_destroy(&chain);
    return all_good;
}

static bool run(struct settings *settings, const cm_streams *streams, cm_failure *failure)
{
    if (settings->printed)
    {
        return true;
    }
    switch (settings->list)
    {
    case LISTING_TABLE:
        listing_write_table(streams->out);
        return true;
    case LISTING_JSON:
        listing_write_json(streams->out);
        return true;
    default:
        return project(settings, streams, failure);
    }
}

int cm_project_main(int argc, char **argv, const cm_streams *streams)
{
    struct settings settings = {.list = LISTING_NONE};
    cm_failure failure = {.status = 0};
    const bool good = parse_arguments(&settings, argc, argv, streams, &failure) &&
                      run(&settings, streams, &failure);
    return end_program(program, streams, &failure, good ? EXIT_SUCCESS : EXIT_FAILURE);
}
