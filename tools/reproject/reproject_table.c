/* SPDX-License-Identifier: MIT */
#include "reproject_table.h"
#include "reproject_main.h"

#include <cubemap/catalogue.h>

#include "tools/cli/catalogue_name.h"
#include "tools/image/cube_table.h"

static const char *const filters[] = {"nearest", "bilinear", NULL};

/* equirect, cube, and what a mapping is called: of the cube with cube: before it */
static const char *const kinds[] = {"equirect", "cube", NULL};

static const cm_option projections[] = {
    {.id = REPROJECT_FROM,
     .name = "from",
     .kind = CM_OPTION_TEXT,
     .argument = "SPEC",
     .help = "what INPUT is; without it, its shape tells: 2:1 equirect, 6:1 a strip, 4:3 a cross; "
             "%f in the name: six faces",
     .more = "A mapping of one face must be said.",
     .choices = kinds},
    {.id = REPROJECT_TO,
     .name = "to",
     .kind = CM_OPTION_TEXT,
     .argument = "SPEC",
     .help = "what OUTPUT is to be; without it, a cube from an equirectangular image, and an "
             "equirectangular image from all others",
     .choices = kinds},
    {.id = REPROJECT_SIZE,
     .name = "size",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "pixels along the edge of a face or of a square image, 65536 at most, or across an "
             "equirectangular image, even, 262144 at most; without it, the resolution stays the "
             "same: at the equator, and of discs and squares in the mean",
     .more = "A face is then a quarter as wide as an equirectangular image.",
     .low = 1,
     .high = REPROJECT_EQUIRECT_MAX,
     .flags = CM_OPTION_TOLD},
    {.id = REPROJECT_LAYOUT,
     .name = "layout",
     .kind = CM_OPTION_TEXT,
     .argument = "LAYOUT",
     .help = "how OUTPUT holds the faces of a cube",
     .standard = "`faces`",
     .choices = cm_layout_names},
    {.id = REPROJECT_FROM_LAYOUT,
     .name = "from-layout",
     .kind = CM_OPTION_TEXT,
     .argument = "LAYOUT",
     .help = "how INPUT does",
     .choices = cm_layout_names},
    {.id = REPROJECT_FRAME,
     .name = "frame",
     .kind = CM_OPTION_CHOICE,
     .argument = "FRAME",
     .help = "how the faces sit on the axes",
     .standard = "`geo`",
     .choice_at = frame_name_at},
    {.id = REPROJECT_FROM_FRAME,
     .name = "from-frame",
     .kind = CM_OPTION_CHOICE,
     .argument = "FRAME",
     .help = "the same of INPUT",
     .standard = "that of --frame",
     .choice_at = frame_name_at,
     .flags = CM_OPTION_TOLD},
    {.id = REPROJECT_FILTER,
     .name = "filter",
     .kind = CM_OPTION_CHOICE,
     .argument = "FILTER",
     .help = "how pixels are interpolated",
     .more = "Neither averages when the output is smaller than the input.",
     .standard = "`bilinear`",
     .choices = filters},
    {.id = REPROJECT_THREADS,
     .name = "threads",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "threads to use",
     .more = "The output is the same for any number.",
     .standard = "0, one for each core",
     .low = 0,
     .high = 1024},
    {.id = REPROJECT_QUIET,
     .name = "quiet",
     .help = "neither a progress bar nor a line that says what was done"},
};

static const cm_option_group groups[] = {
    {NULL, projections, sizeof projections / sizeof *projections},
    {"Lines", cm_overlay_options, OVERLAY_OPTION_COUNT},
    {NULL, cm_white_line_options, LINE_OPTION_COUNT},
};

const cm_command cm_reproject_command = {
    .name = "cubemap-reproject",
    .usage = "[OPTION]... INPUT OUTPUT",
    .summary =
        "Resamples an image of the sphere from one projection to another: equirectangular, the six "
        "faces of a cube, a disc, as a fisheye lens makes it, or one square. PNG, JPEG, TIFF, EXR "
        "and HDR, with any number of channels and any type of pixel.",
    .groups = groups,
    .group_count = sizeof groups / sizeof *groups,
    .notes =
        "SPEC is:\n"
        "  equirect\n"
        "  cube, which is cube:" CM_MAPPING_RECOMMENDED ", or cube:MAPPING, such as "
        "cube:tangent:c=1.1823\n"
        "  azimuthal:NAME, a disc in a square, such as azimuthal:equidistant:fov=200\n"
        "  a square of the whole sphere: peirce, quincuncial:AZIMUTHAL,SQUARE,\n"
        "    border:AZIMUTHAL,SQUARE, octahedral, octahedral:clarberg or rhealpix\n"
        "\n"
        "Layouts:\n"
        "  faces                 six files: %f in the name stands for 0 to 5; without it,\n"
        "                        NAME.EXT stands for NAME_0.EXT to NAME_5.EXT\n"
        "  strip                 6N x N, the faces in their order\n"
        "  cross                 4N x 3N, the cube unfolded\n"
        "  cross:north=N,south=N the same with the uppermost and the lowest face in\n"
        "                        columns 0 to 3 instead of 1, turned; of cube:healpix\n"
        "                        that is rHEALPix as PROJ has it with lon_0=45\n"
        "\n"
        "Frames:\n"
        "  geo                   front right back left top bottom: lon 0, lon 90 E,\n"
        "                        lon 180, lon 90 W, north, south; a face is drawn with\n"
        "                        north up\n"
        "  gl                    +x -x +y -y +z -z, turned as OpenGL, Vulkan and Direct3D\n"
        "                        store cube maps; +x is lon 0, +y is lon 90 E, +z is\n"
        "                        north\n"
        "  fits                  as geo, in the order top front right back left bottom\n"
        "  s2                    the faces of the S2 library: lon 0, lon 90 E, north,\n"
        "                        lon 180, lon 90 W, south; no cross\n"
        "\n"
        "Meridians and parallels, grid and ellipses lie over the resampled image. The cube of grid "
        "and ellipses is OUTPUT's, else INPUT's, else cube:" CM_MAPPING_RECOMMENDED ".\n"
        "\n"
        "Examples:\n"
        "  cubemap-reproject --size 512 earth.jpg face_%f.png\n"
        "  cubemap-reproject --to cube:qsc --layout cross earth.jpg cross.png\n"
        "  cubemap-reproject --to cube:gnomonic --graticule 15 --indicatrices 5 \\\n"
        "      --layout cross earth.jpg cross.png\n"
        "  cubemap-reproject --size 2048 face_%f.png earth-again.png\n"
        "  cubemap-reproject --from cube --to cube:gnomonic --from-frame geo --frame gl \\\n"
        "      --layout strip face_%f.png sky.exr\n"
        "  cubemap-reproject --from azimuthal:equidistant:fov=185,lat=0 fisheye.jpg \\\n"
        "      world.jpg\n"
        "  cubemap-reproject --to peirce --size 1024 earth.jpg peirce.png",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};
