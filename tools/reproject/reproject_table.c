/* SPDX-License-Identifier: MIT */
#include "reproject_table.h"
#include "reproject_main.h"

#include <cubemap/catalogue.h>
#include <cubemap/image.h>
#include <cubemap/mips.h>

#include "tools/cli/usual_options.h"
#include "tools/image/cube_table.h"

/* As cm_filter_name has them, in the order of cm_filter. */
static const char *const filters[] = {"auto",     "nearest",  "bilinear", "catmull-rom", "mitchell",
                                      "lanczos3", "spline36", "bspline5", "ewa",         NULL};

/* What INPUT and OUTPUT most often are. */
static const char *const kinds[] = {"equirect", "cube", NULL};

static const char *const mappings[] = {"auto", "gnomonic", "tangent", CM_MAPPING_RECOMMENDED, NULL};

const char *const cm_reproject_layouts[] = {"faces", "strip", "cross", "vcross", "column",
                                            "3x2",   "2x3",   "eac",   NULL};

/* In the order of Keep, NotFinite. */
static const char *const densities[] = {"mean", "max", NULL};
static const char *const not_finite[] = {"skip", "zero", "spread", "refuse", NULL};

/* As stream_format.hpp has them. */
static const char *const pipe_formats[] = {
    "ppm",   "pgm",     "pam",       "pfm",  "gray",     "gray16le",   "grayf32le",
    "rgb24", "rgb48le", "gbrpf32le", "rgba", "rgba64le", "gbrapf32le", NULL};

/* As hips_tile_format has them. */
static const char *const tile_formats[] = {"jpeg", "png", "fits", NULL};

static const char *preset_name_at(size_t index)
{
    return index < cm_surface_preset_count() ? cm_surface_preset_at(index)->identifier : NULL;
}

static const cm_option projections[] = {
    {.id = REPROJECT_FROM,
     .name = "from",
     .kind = CM_OPTION_TEXT,
     .argument = "SPEC",
     .help = "what INPUT is; without it, what the file says of itself, or else its shape: 2:1 "
             "equirect, 6:1 a strip, 4:3 a cross; %f in the name: six faces. Or a file of "
             "--sidecar, whose name ends in .json",
     .more =
         "A file says it by what this program has written into it, by the fields of a photo "
         "sphere, or by a georeference, which is warped to degrees if GDAL is there. All others "
         "must be said.",
     .choices = kinds},
    {.id = REPROJECT_TO,
     .name = "to",
     .kind = CM_OPTION_TEXT,
     .argument = "SPEC",
     .help = "what OUTPUT is to be; without it, a cube from an equirectangular image, and an "
             "equirectangular image from all others",
     .choices = kinds},
    {.id = REPROJECT_FOR,
     .name = "for",
     .kind = CM_OPTION_CHOICE,
     .argument = "PROGRAM",
     .help = "OUTPUT as a program wants it, in place of --to, --frame and --layout",
     .choice_at = preset_name_at},
    {.id = REPROJECT_MAPPING,
     .name = "mapping",
     .kind = CM_OPTION_TEXT,
     .argument = "MAPPING",
     .help = "the mapping of OUTPUT's cube, as --to cube:MAPPING; auto chooses one and says why",
     .more =
         "A texture has `gnomonic`, the layout eac `tangent`, and a cube from a cube the mapping "
         "of INPUT. With the filter nearest it is one of equal areas. Else it is the one whose "
         "longest pixel is the shortest, which needs the fewest pixels for the same detail; a "
         "fiftieth "
         "more counts as equal.",
     .choices = mappings},
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
    {.id = REPROJECT_KEEP,
     .name = "keep",
     .kind = CM_OPTION_CHOICE,
     .argument = "DENSITY",
     .help = "without --size, a size that keeps the pixels of INPUT in all, or its density "
             "where it is greatest everywhere",
     .choices = densities},
    {.id = REPROJECT_LAYOUT,
     .name = "layout",
     .kind = CM_OPTION_TEXT,
     .argument = "LAYOUT",
     .help = "how OUTPUT holds the faces of a cube",
     .standard = "`faces`",
     .choices = cm_reproject_layouts},
    {.id = REPROJECT_FROM_LAYOUT,
     .name = "from-layout",
     .kind = CM_OPTION_TEXT,
     .argument = "LAYOUT",
     .help = "how INPUT does",
     .choices = cm_reproject_layouts},
    CM_USUAL_FRAME(REPROJECT_FRAME),
    {.id = REPROJECT_FROM_FRAME,
     .name = "from-frame",
     .kind = CM_OPTION_CHOICE,
     .argument = "FRAME",
     .help = "the same of INPUT",
     .standard = "that of --frame",
     .choice_at = frame_name_at,
     .flags = CM_OPTION_TOLD},
    {.id = REPROJECT_ROTATE,
     .name = "rotate",
     .kind = CM_OPTION_TEXT,
     .argument = "LON,LAT[,ROLL]",
     .help = "where the middle of OUTPUT is, and how far it is turned about it, in degrees; or an "
             "orientation that has a name",
     .choice_at = orientation_name_at},
    {.id = REPROJECT_FROM_ROTATE,
     .name = "from-rotate",
     .kind = CM_OPTION_TEXT,
     .argument = "LON,LAT[,ROLL]",
     .help = "the same of INPUT",
     .choice_at = orientation_name_at},
};

static const cm_option values[] = {
    {.id = REPROJECT_FILTER,
     .name = "filter",
     .kind = CM_OPTION_CHOICE,
     .argument = "FILTER",
     .help = "how pixels are interpolated",
     .more =
         "Only ewa averages when OUTPUT is smaller than INPUT. The line that says what was done "
         "says which was taken: of floats auto is content with an error of 1e-4 of their range.",
     .standard = "`auto`",
     .choices = filters},
    {.id = REPROJECT_LINEAR,
     .name = "linear",
     .help = "mix colours as light, of images that are stored with sRGB's curve"},
    {.id = REPROJECT_GAMMA,
     .name = "gamma",
     .kind = CM_OPTION_NUMBER,
     .argument = "G",
     .help = "mix colours as light, which is what is stored to the power G",
     .low = 0.1,
     .high = 10},
    {.id = REPROJECT_STORED,
     .name = "stored",
     .help = "no curve is put on or taken off between formats of light, EXR and HDR, and others"},
    {.id = REPROJECT_VECTOR,
     .name = "vector",
     .kind = CM_OPTION_WHOLE,
     .argument = "C",
     .help = "channels C to C+2, counted from 1, are a vector in INPUT's axes, to be turned into "
             "OUTPUT's",
     .more = "In files of whole numbers it is as normal maps have it: 0 to 255, or to 65535, "
             "stands for -1 to 1.",
     .low = 1,
     .high = CM_CHANNELS_MAX - 2},
    {.id = REPROJECT_NOT_FINITE,
     .name = "not-finite",
     .kind = CM_OPTION_CHOICE,
     .argument = "WHAT",
     .help = "what becomes of NaN and infinities: their neighbours stand for them, they are 0, "
             "they spread as far as the filter reaches, or the image is refused",
     .standard = "`skip`, and with the filter nearest `spread`",
     .choices = not_finite},
    {.id = REPROJECT_DITHER, .name = "dither", .help = "hide the steps of whole numbers in noise"},
    {.id = REPROJECT_TOLERANCE,
     .name = "tolerance",
     .kind = CM_OPTION_NUMBER,
     .argument = "PIXELS",
     .help = "how far off positions on INPUT may be; 0: as exact as can be",
     .standard = "1/4096",
     .low = 0,
     .high = 1},
    {.id = REPROJECT_COMPRESSION,
     .name = "compression",
     .kind = CM_OPTION_TEXT,
     .argument = "NAME",
     .help = "of OUTPUT's files: TIFF none, lzw, zip, packbits; EXR none, rle, zip, zips, piz, "
             "pxr24, b44, "
             "b44a, dwaa, dwab; JPEG the quality, 1 to 100; PNG the effort, 0 to 9"},
    {.id = REPROJECT_MIPS,
     .name = "mips",
     .help = "also pictures of half the size, a quarter and so on to one pixel a face, filtered "
             "across seams: in a .dds or .ktx2 file, and else as files NAME_m1.EXT, NAME_m2.EXT",
     .more = "Of pictures with sRGB's curve in textures they are means of light."},
    {.id = REPROJECT_BORDER,
     .name = "border",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "around each face of a cube N pixels of what the sphere has there, as the layout "
             "LAYOUT:border=N",
     .low = 1,
     .high = CM_BORDER_MOST},
    {.id = REPROJECT_PARTS,
     .name = "parts",
     .help = "the six faces are parts of one OpenEXR file, each with the name of its face"},
    {.id = REPROJECT_ORDER,
     .name = "order",
     .kind = CM_OPTION_WHOLE,
     .argument = "K",
     .help = "of an OUTPUT that ends in /, a folder of HiPS tiles for sky viewers: the greatest "
             "order; without it, the resolution of INPUT, and 3 at least. --size is then the edge "
             "of a tile",
     .low = 0,
     .high = 13},
    {.id = REPROJECT_TILES,
     .name = "tiles",
     .kind = CM_OPTION_CHOICE,
     .argument = "FORMAT",
     .help = "of a folder of HiPS tiles: jpeg, the smallest; png, which keeps alpha; fits, which "
             "keeps the numbers of one channel",
     .standard = "`fits` of one channel that is not of bytes, and else `png`",
     .choices = tile_formats},
    {.id = REPROJECT_CREATOR_DID,
     .name = "creator-did",
     .kind = CM_OPTION_TEXT,
     .argument = "IVOID",
     .help = "who publishes HiPS tiles under which name, as in ivo://authority/P/name; without "
             "it, a placeholder"},
    {.id = REPROJECT_SIDECAR,
     .name = "sidecar",
     .help = "also write what OUTPUT is into a file beside it that ends in .json, which is read "
             "again where OUTPUT is INPUT"},
    {.id = REPROJECT_GEOREFERENCE,
     .name = "georeference",
     .help = "write where OUTPUT is on Earth into a TIFF file: EPSG:4326 of an equirectangular "
             "image, EPSG:3857 of mercator",
     .more = "Without this it is written where INPUT has a georeference, too."},
    CM_USUAL_THREADS(REPROJECT_THREADS),
    {.id = REPROJECT_MEMORY,
     .name = "memory",
     .kind = CM_OPTION_TEXT,
     .argument = "SIZE",
     .help = "what the program may take of memory, such as 512M or 2G, 64M at least; what does not "
             "fit goes to temporary files, which are told beforehand",
     .more =
         "Units are K, M, G and T of 1024 each; a number alone is M. Files are in the folder of "
         "the environment variable TMPDIR, or else beside OUTPUT, and have no name: nothing is "
         "left of them, whatever happens. The output is the same for any SIZE. The program and its "
         "libraries take 0.15 GB themselves: a smaller SIZE is exceeded."},
    {.id = REPROJECT_RESUME,
     .name = "resume",
     .help = "keep what is done in the folder OUTPUT.resume until all is, and go on from there",
     .more = "Whatever has ended the program, the same command does not again what was done. The "
             "folder takes as much room as OUTPUT without compression, and goes away at the end."},
    {.id = REPROJECT_MANIFEST,
     .name = "manifest",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "also write what was made of what into FILE, as JSON: files with their sizes and "
             "checksums, surface, filter"},
    CM_USUAL_QUIET(REPROJECT_QUIET),
};

static const cm_option films[] = {
    {.id = REPROJECT_START,
     .name = "start",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "the number of the first picture of a film",
     .standard = "the lowest that is there, and of a pipe 1",
     .low = 0,
     .high = 999999999,
     .flags = CM_OPTION_TOLD},
    {.id = REPROJECT_COUNT,
     .name = "count",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "how many pictures a film has",
     .more = "All of these must be there: a number that is missing is an error before anything is "
             "done.",
     .standard = "all",
     .low = 1,
     .high = 999999999,
     .flags = CM_OPTION_TOLD},
    {.id = REPROJECT_RAW,
     .name = "raw",
     .kind = CM_OPTION_TEXT,
     .argument = "WIDTHxHEIGHT:FORMAT",
     .help = "what comes from standard input are bare samples; FORMAT as ffmpeg calls it: gray, "
             "gray16le, grayf32le, rgb24, rgb48le, gbrpf32le, rgba, rgba64le or gbrapf32le"},
    {.id = REPROJECT_PIPE,
     .name = "pipe",
     .kind = CM_OPTION_CHOICE,
     .argument = "FORMAT",
     .help = "what goes to standard output: ppm, pgm, pam or pfm, or bare samples in a FORMAT of "
             "--raw",
     .standard = "pgm or ppm of whole numbers, pfm of light, pam of more channels",
     .choices = pipe_formats,
     .flags = CM_OPTION_TOLD},
};

static const cm_option_group groups[] = {
    {NULL, projections, sizeof projections / sizeof *projections},
    {"Values and files", values, sizeof values / sizeof *values},
    {"Films and pipes", films, sizeof films / sizeof *films},
    {"Lines", cm_overlay_options, OVERLAY_OPTION_COUNT},
    {NULL, cm_white_line_options, LINE_OPTION_COUNT},
};

const cm_command cm_reproject_command = {
    .name = "cubemap-reproject",
    .usage = "[OPTION]... INPUT OUTPUT",
    .summary =
        "Resamples an image of the sphere from one projection to another: equirectangular, the six "
        "faces of a cube, what a camera or a fisheye lens sees, HEALPix, a disc, or one square. "
        "PNG, "
        "JPEG, TIFF, EXR, HDR, PPM and PFM, with any number of channels and any type of pixel, and "
        "the textures DDS and KTX2, and maps of HEALPix in FITS. A folder, with / at its end, "
        "gets HiPS tiles for sky viewers.",
    .groups = groups,
    .group_count = sizeof groups / sizeof *groups,
    .notes =
        "SPEC is KIND[:PARAMETERS][;KEY=VALUE...]:\n"
        "  equirect              2:1; or a part of it, as in\n"
        "                        \"equirect;west=-10;east=30;south=35;north=70\"\n"
        "  cube, which is cube:" CM_MAPPING_RECOMMENDED ", or cube:MAPPING, such as "
        "cube:tangent:c=1.1823\n"
        "  view:fov=90,lon=20    what a camera sees\n"
        "  fisheye, dual-fisheye, dual-paraboloid, equal-area, mercator, healpix:NSIDE\n"
        "  healpix:NSIDE:nest    in .fits files, which else are in the order RING\n"
        "  azimuthal:NAME, a disc in a square, such as azimuthal:equidistant:fov=200\n"
        "  a square of the whole sphere: peirce, quincuncial:AZIMUTHAL,SQUARE,\n"
        "    border:AZIMUTHAL,SQUARE, octahedral, octahedral:clarberg or rhealpix\n"
        "Keys are size, height, frame and layout, as far as the kind has them.\n"
        "\n"
        "Layouts:\n"
        "  faces                 six files: %f in the name stands for 0 to 5; without it,\n"
        "                        NAME.EXT stands for NAME_0.EXT to NAME_5.EXT\n"
        "  strip                 6N x N, the faces in their order; column: N x 6N\n"
        "  3x2, 2x3              in rows of three, or of two\n"
        "  cross                 4N x 3N, the cube unfolded; vcross: 3N x 4N\n"
        "  cross:north=N,south=N the same with the uppermost and the lowest face in\n"
        "                        columns 0 to 3 instead of 1, turned; of cube:healpix\n"
        "                        that is rHEALPix as PROJ has it with lon_0=45\n"
        "  eac, eac:pad=N        3N x 2N, as YouTube stores equi-angular cubes\n"
        "  faces:border=N, and so strip, column, 3x2 and 2x3: N pixels of what the\n"
        "                        sphere has around each face\n"
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
        "                        lon 180, lon 90 W, south\n"
        "\n"
        "Films:\n"
        "  frame_%04d.png        INPUT and OUTPUT: all numbers there are, by one plan;\n"
        "                        the pictures must be alike\n"
        "  -                     standard input or output: PPM, PGM, PAM or PFM, one\n"
        "                        picture after another; or bare samples, with --raw and\n"
        "                        --pipe\n"
        "\n"
        "Meridians and parallels, grid and ellipses lie over the resampled image. The cube of grid "
        "and ellipses is OUTPUT's, else INPUT's, else cube:" CM_MAPPING_RECOMMENDED ".\n"
        "\n"
        "Examples:\n"
        "  cubemap-reproject --size 512 earth.jpg face_%f.png\n"
        "  cubemap-reproject --to cube:qsc --layout cross earth.jpg cross.png\n"
        "  cubemap-reproject --for unity --filter lanczos3 --linear sky.png sky_%f.png\n"
        "  cubemap-reproject --to view:fov=90 --rotate 10,40 --size 800 in.jpg view.png\n"
        "  cubemap-reproject --to cube:gnomonic --graticule 15 --indicatrices 5 \\\n"
        "      --layout cross earth.jpg cross.png\n"
        "  cubemap-reproject --mips sky.hdr sky.ktx2\n"
        "  cubemap-reproject --size 2048 face_%f.png earth-again.png\n"
        "  cubemap-reproject --from cube --to cube:gnomonic --from-frame geo --frame gl \\\n"
        "      --layout strip face_%f.png sky.exr\n"
        "  cubemap-reproject --from azimuthal:equidistant:fov=185,lat=0 fisheye.jpg \\\n"
        "      world.jpg\n"
        "  cubemap-reproject --to peirce --size 1024 earth.jpg peirce.png\n"
        "  cubemap-reproject frame_%04d.png cube_%04d_%f.png\n"
        "  ffmpeg -v error -i in.mp4 -f image2pipe -c:v ppm - |\n"
        "      cubemap-reproject --to cube --layout 3x2 - - |\n"
        "      ffmpeg -v error -f image2pipe -c:v ppm -r 30 -i - out.mp4",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};
