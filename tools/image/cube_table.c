/* SPDX-License-Identifier: MIT */
#include "cube_table.h"

const char *const cm_layout_names[] = {"faces", "strip", "cross", NULL};

const cm_option cm_overlay_options[] = {
    {.id = OVERLAY_GRATICULE,
     .name = "graticule",
     .kind = CM_OPTION_NUMBER,
     .argument = "DEGREES",
     .help = "meridians and parallels, so many degrees apart, of which 360 is a multiple",
     .more = "Towards the poles there are fewer meridians. Meridians end at the parallel where "
             "they come too close to each other, and at the "
             "last parallel but for a few that reach the pole, 90 degrees apart or a little more.",
     .low = 0.01,
     .high = 180},
    {.id = OVERLAY_GRID,
     .name = "grid",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "the lines of u and v that divide each face into N x N cells, its edges included",
     .low = 1,
     .high = 1024},
    {.id = OVERLAY_INDICATRICES,
     .name = "indicatrices",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "Tissot's ellipses at the centres of N x N cells of each face, as large as they can "
             "be without overlap",
     .more = "They are the ellipses that the derivative of the output's projection makes of equal "
             "circles of the sphere, and the line that says what was done says the circles' "
             "radius. Where the derivative jumps, as on the diagonals of qsc, it is that of one "
             "side. At a pole of an equirectangular image there is none.",
     .low = 1,
     .high = 256},
    {.id = OVERLAY_INDICATRICES_RADIUS,
     .name = "indicatrices-radius",
     .kind = CM_OPTION_NUMBER,
     .argument = "DEGREES",
     .help = "the radius of their circles on the sphere, to have the same in several pictures",
     .low = 1e-6,
     .high = 45,
     .flags = CM_OPTION_TOLD},
};

#define LINE_WIDTH(usual)                                                                          \
    {                                                                                              \
        .id = OVERLAY_LINE_WIDTH, .name = "line-width", .kind = CM_OPTION_NUMBER,                  \
        .argument = "PIXELS", .help = "how wide lines are",                                        \
        .more = "A thin casing is beside each.", .standard = usual, .low = 0.1, .high = 100        \
    }
#define LINE_COLOR(usual)                                                                          \
    {                                                                                              \
        .id = OVERLAY_LINE_COLOR, .name = "line-color", .kind = CM_OPTION_TEXT,                    \
        .argument = "RRGGBB", .help = "in hexadecimal digits", .standard = usual                   \
    }

const cm_option cm_white_line_options[] = {LINE_WIDTH("1.5"), LINE_COLOR("ffffff")};
const cm_option cm_black_line_options[] = {LINE_WIDTH("1"), LINE_COLOR("000000")};
