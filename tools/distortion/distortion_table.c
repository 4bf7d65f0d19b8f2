/* SPDX-License-Identifier: MIT */
#include "distortion_table.h"
#include "distortion_main.h"

#include <cubemap/catalogue.h>

#include <math.h>

#include "tools/cli/usual_options.h"
#include "tools/cli/colormap_name.h"
#include "tools/image/cube_table.h"

static const cm_option pictures[] = {
    {.id = DISTORTION_MAPPING,
     .letter = 'm',
     .name = "mapping",
     .kind = CM_OPTION_TEXT,
     .argument = "MAPPING",
     .help = "NAME, NAME:PRESET or NAME:PARAMETER=VALUE[,...]; cubemap-project --list prints them",
     .more = "Of mappings of one face, such as `azimuthal:lambert` or `peirce`, the picture is "
             "that; beside a disc it is white, or NaN with --values.",
     .standard = "`" CM_MAPPING_RECOMMENDED "`",
     .choice_at = mapping_name_at},
    CM_USUAL_FRAME(DISTORTION_FRAME),
    {.id = DISTORTION_QUANTITY,
     .name = "quantity",
     .kind = CM_OPTION_CHOICE,
     .argument = "QUANTITY",
     .help = "what to draw",
     .standard = "`area`",
     .choice_at = quantity_name_at},
    {.id = DISTORTION_LAYOUT,
     .name = "layout",
     .kind = CM_OPTION_CHOICE,
     .argument = "LAYOUT",
     .help = "`faces`: six files, %f in the name stands for 0 to 5; `strip`: 6N x N; `cross`: "
             "4N x 3N, the cube unfolded",
     .more = "Without %f NAME.EXT stands for NAME_0.EXT to NAME_5.EXT. The empty parts of a cross "
             "are white, or NaN with --values.",
     .standard = "`cross`",
     .choices = cm_layout_names,
     .flags = CM_OPTION_TOLD},
    {.id = DISTORTION_FACE,
     .name = "face",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "one face alone",
     .more = "All faces are alike, but for those of `healpix`.",
     .low = 0,
     .high = 5},
    {.id = DISTORTION_SIZE,
     .name = "size",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "pixels along the edge of a face",
     .standard = "256",
     .low = 1,
     .high = DISTORTION_FACE_MAX},
    {.id = DISTORTION_COLORS,
     .name = "colors",
     .kind = CM_OPTION_TEXT,
     .argument = "SPEC",
     .help = "a map of cubemap-colormap, such as sequential-single:hue=140; sequential scales go "
             "from its light end to its dark one",
     .more = "The scales of areas, scale and texels are logarithmic about the mean, or 1, which "
             "has the map's middle, so that x and 1/x are equally far from it. Those of isotropy "
             "and deformation are linear, from the map's light end, which is little distortion, to "
             "its dark one.",
     .standard = "`diverging-lightness`, of isotropy and deformation `sequential-custom`",
     .choice_at = colormap_name_at},
    {.id = DISTORTION_REVERSE, .name = "reverse", .help = "the colours the other way round"},
    {.id = DISTORTION_RANGE,
     .name = "range",
     .kind = CM_OPTION_TEXT,
     .argument = "LOW:HIGH",
     .help = "the values at the ends of the colours. What is beyond has the end's colour, and the "
             "program says how much that is",
     .more = "On a logarithmic scale a range that reaches less far to one side uses less of the "
             "colours there.",
     .standard = "0.25:4 times the mean for areas, 0.5:2 for texel-aspect, 1:2 for isotropy, 0:40 "
                 "for deformation"},
    {.id = DISTORTION_ISOLINES,
     .name = "isolines",
     .kind = CM_OPTION_NUMBER,
     .argument = "STEP",
     .help = "lines at the multiples of STEP, in the quantity's unit",
     .low = 1e-6,
     .high = HUGE_VAL,
     .flags = CM_OPTION_TOLD},
    {.id = DISTORTION_VALUES,
     .name = "values",
     .help = "the numbers themselves, in floats, instead of colours"},
    {.id = DISTORTION_LEGEND,
     .name = "legend",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "a strip of the colours with numbers",
     .more = "From LOW to HIGH, with numbers at its ends, middle and quarters, 520 by 62 pixels."},
    CM_USUAL_THREADS(DISTORTION_THREADS),
    CM_USUAL_QUIET(DISTORTION_QUIET),
};

static const cm_option_group groups[] = {
    {NULL, pictures, sizeof pictures / sizeof *pictures},
    {"Lines", cm_overlay_options, OVERLAY_OPTION_COUNT},
    {NULL, cm_black_line_options, LINE_OPTION_COUNT},
};

const cm_command cm_distortion_command = {
    .name = "cubemap-distortion",
    .usage = "[OPTION]... OUTPUT",
    .summary =
        "Draws the distortion of a mapping between the sphere and the faces of a cube, a disc or "
        "one square: the colour of each pixel is that of the quantity at its centre. PNG, JPEG and "
        "TIFF; with --values TIFF and EXR.",
    .groups = groups,
    .group_count = sizeof groups / sizeof *groups,
    .notes = "Quantities:\n"
             "  area           D_A: areas on the map over those of the sphere; 1 is the mean\n"
             "  isotropy       D_I: axes of Tissot's ellipse, longer over shorter\n"
             "  deformation    omega: the most by which an angle can differ\n"
             "  scale          s: as area, in units of u and v; 6/pi is a cube's mean\n"
             "  texel-aspect   L_x / L_y: width over height of a texel on the sphere\n"
             "  texel-area     L_x L_y: width times height, over a texel's mean area\n"
             "\n"
             "Examples:\n"
             "  cubemap-distortion -m gnomonic --range 0.3:3 --legend legend.png area.png\n"
             "  cubemap-distortion -m qsc --quantity deformation --face 0 --isolines 5 qsc.png\n"
             "  cubemap-distortion -m healpix --quantity isotropy --graticule 15 cross.png\n"
             "  cubemap-distortion -m tangent --values --layout strip area.exr\n"
             "  cubemap-distortion -m peirce --size 512 --graticule 15 peirce.png",
    .words = "LOW HIGH",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};
