/* SPDX-License-Identifier: MIT */
#include "orient_main.h"
#include "orient_table.h"

#include <cubemap/orient.h>

#include "tools/cli/usual_options.h"

static const char *measure_name_at(size_t index)
{
    return index < 5 ? cm_orient_measure_name((cm_orient_measure)index) : NULL;
}

static const char *const means[] = {"face", "sphere", NULL};

static const cm_option options[] = {
    {.id = ORIENT_MAPPING,
     .letter = 'm',
     .name = "mapping",
     .kind = CM_OPTION_TEXT,
     .argument = "SPEC",
     .help = "the mapping of the faces, as cubemap-project --list names them",
     .standard = "`" CM_MAPPING_RECOMMENDED "`",
     .choice_at = mapping_name_at},
    {.id = ORIENT_MEASURE,
     .name = "measure",
     .kind = CM_OPTION_CHOICE,
     .argument = "WHAT",
     .help = "what is to be least: `deformation` (the mean of the maximum angular deformation, in "
             "degrees), `isotropy` (the mean of D_I, the ratio of the axes), `area` (the mean of "
             "|ln D_A|), `scale` (the mean of s, the areal scale) or `edges` (the length of the "
             "edges of faces over the mask's pixels, in km)",
     .standard = "`deformation`",
     .choice_at = measure_name_at,
     .flags = CM_OPTION_TOLD},
    {.id = ORIENT_OVER,
     .name = "over",
     .kind = CM_OPTION_CHOICE,
     .argument = "WHAT",
     .help = "in means, equal areas count alike of this",
     .standard = "`sphere`",
     .choices = means},
    {.id = ORIENT_THRESHOLD,
     .name = "threshold",
     .kind = CM_OPTION_NUMBER,
     .argument = "T",
     .help = "pixels of T or more count fully, and others do not count",
     .low = 0,
     .high = 1},
    {.id = ORIENT_INVERT,
     .name = "invert",
     .help = "dark pixels count, bright ones do not; before the threshold"},
    {.id = ORIENT_RESOLUTION,
     .name = "resolution",
     .kind = CM_OPTION_NUMBER,
     .argument = "DEG",
     .help = "how finely the best is followed, in degrees",
     .standard = "0.1",
     .low = 0.01,
     .high = 10},
    {.id = ORIENT_BOXES,
     .name = "boxes",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "the rotations, in boxes, that the proof may look at; with more the grid is finer, "
             "too",
     .standard = "100000, of edges 600000",
     .low = 1,
     .high = 100000000,
     .flags = CM_OPTION_TOLD},
    {.id = ORIENT_EVALUATE,
     .name = "evaluate",
     .kind = CM_OPTION_TEXT,
     .argument = "LON,LAT[,ROLL]|NAME",
     .help = "do not search: print the measure in this orientation",
     .choice_at = orientation_name_at},
    {.id = ORIENT_PICTURE,
     .name = "picture",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "write a picture of the faces: above as they are without rotation, below in the best "
             "orientation",
     .more = "With --evaluate, below in that one."},
    {.id = ORIENT_IMAGE,
     .name = "image",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "the equirectangular image that the picture shows; without it, the mask, the redder "
             "the more it is deformed"},
    {.id = ORIENT_SIZE,
     .name = "size",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "pixels along a face in the picture",
     .standard = "256",
     .low = 8,
     .high = 4096},
    CM_USUAL_THREADS(ORIENT_THREADS),
    {.id = ORIENT_JSON,
     .name = "json",
     .help = "print the result as JSON",
     .more = "It has the best local optima: [LON, LAT, ROLL, value] each."},
    {.id = ORIENT_QUIET,
     .letter = 'q',
     .name = "quiet",
     .help = "no progress bar; without a terminal there is none either"},
    {.id = ORIENT_QUIET, .name = "no-progress", .help = "the same as --quiet"},
    {.id = ORIENT_LIST,
     .name = "list",
     .help = "print the orientations that have a name, a line each",
     .more = "Name, mapping, measure, LON, LAT, ROLL, the measure without rotation and with it. "
             "They are for land, data/land-1440.png."},
};

static const cm_option_group groups[] = {{NULL, options, sizeof options / sizeof *options}};

const cm_command cm_orient_command = {
    .name = "cubemap-orient",
    .usage = "[OPTION]... MASK",
    .summary =
        "Finds how the base cube is best turned so that what the mask shows suffers least from a "
        "mapping, over all rotations, and prints the orientation and what it gains. MASK is an "
        "equirectangular image, longitude -180 at its left edge, north at the top, twice as wide "
        "as high; how bright a pixel is says how much it counts.",
    .groups = groups,
    .group_count = 1,
    .notes =
        "The orientation is printed as \"LON LAT ROLL\", in degrees: the middle of the cube's "
        "front is at LON and LAT, and the cube is turned by ROLL about it, anticlockwise seen from "
        "outside.\n\n"
        "Example:\n"
        "  cubemap-orient --picture before-after.png data/land-1440.png",
    .words = "LON LAT ROLL",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};
