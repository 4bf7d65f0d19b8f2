/* SPDX-License-Identifier: MIT */
#include "colormap_table.h"
#include "colormap_main.h"

#include "tools/cli/colormap_name.h"

const char *const cm_colormap_formats[] = {"json", "csv", "matplotlib", "gimp", "png", NULL};

static const cm_option options[] = {
    {.id = COLORMAP_OUTPUT,
     .letter = 'o',
     .name = "output",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "what to write",
     .standard = "standard output"},
    {.id = COLORMAP_FORMAT,
     .name = "format",
     .kind = CM_OPTION_CHOICE,
     .argument = "FORMAT",
     .help = "`json` (everything that is known of the map, and its colours), `csv` (a line for "
             "each colour), `matplotlib` (a Python file that defines and registers the map), "
             "`gimp` (a palette) or `png`",
     .standard = "by the end of FILE's name, .json, .csv, .py, .gpl or .png, and `csv` for "
                 "standard output",
     .choices = cm_colormap_formats,
     .flags = CM_OPTION_TOLD},
    {.id = COLORMAP_SAMPLES,
     .name = "samples",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "the number of colours",
     .standard = "256; 257 for diverging maps, so that their middle is one; 8 for qualitative "
                 "ones; for `png` otherwise one for each column",
     .low = 1,
     .high = 65536},
    {.id = COLORMAP_REVERSE,
     .name = "reverse",
     .help = "the last colour first",
     .more = "t in the tables remains that of the map."},
    {.id = COLORMAP_FIT,
     .name = "fit",
     .help = "lower the saturation until no colour is outside sRGB, and say to what",
     .more = "Where the pale ends of the map stick out too, its saturation range is raised first, "
             "which makes them paler."},
    {.id = COLORMAP_STRICT,
     .name = "strict",
     .help = "refuse a map with colours outside sRGB; without it they are cut, and a warning says "
             "so"},
    {.id = COLORMAP_NAME,
     .name = "name",
     .kind = CM_OPTION_TEXT,
     .argument = "NAME",
     .help = "the name under which `matplotlib` or `gimp` know the map: letters, digits, -, _ and "
             "point",
     .standard = "cubemap-MODEL"},
    {.id = COLORMAP_SIZE,
     .name = "size",
     .kind = CM_OPTION_TEXT,
     .argument = "WxH",
     .help = "of the `png`, in pixels",
     .standard = "512x64"},
    {.id = COLORMAP_TEST_PATTERN,
     .name = "test-pattern",
     .help = "for `png`: Kovesi's sine wave, fading from top to bottom, over a ramp; where it is "
             "hard to see, the map is flat"},
    {.id = COLORMAP_LIST, .name = "list", .help = "print the maps and their parameters"},
};

static const cm_option_group groups[] = {{NULL, options, sizeof options / sizeof *options}};

const cm_command cm_colormap_command = {
    .name = "cubemap-colormap",
    .usage = "[OPTION]... MAP",
    .summary =
        "Makes a perceptually uniform colour map: equal steps of the data are equal steps of "
        "CIELUV, or of CAM16-UCS (uniform-...). MAP is NAME or NAME:PARAMETER=VALUE[,...]; --list "
        "prints them.",
    .groups = groups,
    .group_count = 1,
    .notes = "Examples:\n"
             "  cubemap-colormap rainbow:saturation=1.5 -o rainbow.json\n"
             "  cubemap-colormap uniform-blue-red --samples 11 -o eleven.csv\n"
             "  cubemap-colormap diverging --test-pattern --size 768x160 -o diverging.png\n"
             "  cubemap-colormap qualitative --samples 6 --format gimp",
    .operand = CM_OPTION_TEXT,
    .choice_at = colormap_name_at,
    .bare_version = 1};
