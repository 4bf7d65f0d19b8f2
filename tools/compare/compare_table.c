/* SPDX-License-Identifier: MIT */
#include "compare_main.h"
#include "compare_table.h"
#include "tools/cli/colormap_name.h"
#include "tools/cli/usual_options.h"

#include <math.h>

static const char *const measures[MEASURE_COUNT + 1] = {
    [MEASURE_MEAN] = "mean",       [MEASURE_RMSE] = "rmse",        [MEASURE_MAX] = "max",
    [MEASURE_BIAS] = "bias",       [MEASURE_MSE] = "mse",          [MEASURE_PSNR] = "psnr",
    [MEASURE_WS_PSNR] = "ws-psnr", [MEASURE_S_PSNR] = "s-psnr",    [MEASURE_SSIM] = "ssim",
    [MEASURE_FLIP] = "flip",       [MEASURE_HDR_FLIP] = "hdr-flip"};

static const char *const differences[] = {[DIFFERENCE_ERROR] = "error",
                                          [DIFFERENCE_SSIM] = "ssim",
                                          [DIFFERENCE_FLIP] = "flip",
                                          [DIFFERENCE_HDR_FLIP] = "hdr-flip",
                                          NULL};

const char *cm_compare_measure_name(size_t index)
{
    return index < MEASURE_COUNT ? measures[index] : NULL;
}

static const cm_option options[] = {
    {.id = COMPARE_MAX_MEAN,
     .name = "max-mean",
     .kind = CM_OPTION_NUMBER,
     .argument = "X",
     .help = "exit status 1 if the mean absolute error is above X",
     .high = HUGE_VAL},
    {.id = COMPARE_MAX_RMSE,
     .name = "max-rmse",
     .kind = CM_OPTION_NUMBER,
     .argument = "X",
     .help = "exit status 1 if the root of the mean square error is above X",
     .high = HUGE_VAL},
    {.id = COMPARE_MAX,
     .name = "max",
     .kind = CM_OPTION_NUMBER,
     .argument = "X",
     .help = "exit status 1 if the largest error is above X",
     .high = HUGE_VAL},
    {.id = COMPARE_QUIET, .name = "quiet", .help = "print nothing but errors"},
    {.id = COMPARE_MEASURE,
     .letter = 'm',
     .name = "measure",
     .kind = CM_OPTION_TEXT,
     .argument = "LIST",
     .help = "what to print, apart by commas; see below",
     .standard = "`mean,rmse,max,psnr`",
     .choice_at = cm_compare_measure_name},
    {.id = COMPARE_PEAK,
     .name = "peak",
     .kind = CM_OPTION_TEXT,
     .argument = "X",
     .help = "the greatest value that there can be, in the unit of errors, for PSNR and SSIM; or "
             "`reference`, the greatest value of A",
     .standard = "255 for integers, else 1"},
    {.id = COMPARE_PIXELS_PER_DEGREE,
     .name = "pixels-per-degree",
     .kind = CM_OPTION_NUMBER,
     .argument = "X",
     .help = "FLIP: pixels of a degree of the visual field",
     .more = "The width of an equirectangular image over 360, if it is looked at from its middle.",
     .standard = "67.02, a display 0.7 m wide with 3840 pixels, from 0.7 m",
     .low = 0.01,
     .high = 1000},
    {.id = COMPARE_BY_AREA,
     .name = "by-area",
     .help = "each pixel weighs as its solid angle, in all measures; for equirectangular images",
     .more = "`psnr` then is `ws-psnr`."},
    {.id = COMPARE_SURFACE,
     .name = "surface",
     .kind = CM_OPTION_TEXT,
     .argument = "SPEC",
     .help = "how the sphere lies on B, as cubemap-reproject has it in one image: "
             "`cube:qsc;layout=cross`, `azimuthal:equidistant:fov=185`",
     .more = "B is resampled onto A by the quintic spline; what either does not show does not "
             "count.",
     .standard = "what B says of itself, or `equirect` if it is 2:1"},
    {.id = COMPARE_REFERENCE_SURFACE,
     .name = "reference-surface",
     .kind = CM_OPTION_TEXT,
     .argument = "SPEC",
     .help = "the same of A",
     .standard = "what A says of itself, or `equirect` if it is 2:1"},
    {.id = COMPARE_BORDER,
     .name = "border",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "pixels at each edge that are looked at, and do not count; 5 for SSIM without windows "
             "that an edge cuts",
     .standard = "0",
     .low = 0,
     .high = 65536},
    {.id = COMPARE_SKIP_NOT_FINITE,
     .name = "skip-not-finite",
     .help = "pixels with a NaN or an infinity in either image do not count",
     .more = "For SSIM and FLIP neither do those with one in their window."},
    {.id = COMPARE_JSON, .name = "json", .help = "print JSON; `null` is what is not finite"},
    CM_USUAL_THREADS(COMPARE_THREADS),
};

static const cm_option pictures[] = {
    {.id = COMPARE_DIFFERENCE,
     .name = "difference",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "draw the difference in colours: PNG, JPEG or TIFF"},
    {.id = COMPARE_DIFFERENCE_OF,
     .name = "difference-of",
     .kind = CM_OPTION_CHOICE,
     .argument = "WHAT",
     .help = "what the picture shows; an error is the largest of a pixel's channels",
     .standard = "error",
     .choices = differences},
    {.id = COMPARE_RANGE,
     .name = "range",
     .kind = CM_OPTION_TEXT,
     .argument = "LOW:HIGH",
     .help = "the values at the ends of the colours. What is beyond has the end's colour",
     .standard = "0 to the largest error; SSIM and FLIP 0:1"},
    {.id = COMPARE_COLORS,
     .name = "colors",
     .kind = CM_OPTION_TEXT,
     .argument = "SPEC",
     .help = "a map of cubemap-colormap; what does not count, or is not finite, is grey",
     .standard = "`uniform-purple-yellow`",
     .choice_at = colormap_name_at},
};

static const cm_option_group groups[] = {
    {NULL, options, sizeof options / sizeof *options},
    {"A picture of the difference", pictures, sizeof pictures / sizeof *pictures}};

const cm_command cm_compare_command = {
    .name = "cubemap-compare",
    .usage = "[OPTION]... A B",
    .summary =
        "Prints how far image B is from image A, over all pixels and channels: the mean absolute "
        "error, the root of the mean square error, the largest error and where it is, and the peak "
        "signal-to-noise ratio. Both must be of the same size, unless it is said how the sphere "
        "lies on them, by an option or by the files themselves, and have the same number of "
        "channels. A name with %f is of six faces, which are one image, a strip.\n\n"
        "If both hold integers, errors are in grey levels of 8 bits (0 to 255) and the peak is "
        "255; otherwise errors are in the images' own unit and the peak is 1. Where both hold the "
        "same infinity, or both a NaN, there is no error; where one holds what is not a finite "
        "number, the error is infinite.",
    .groups = groups,
    .group_count = sizeof groups / sizeof *groups,
    .notes = "Measures:\n"
             "  mean      the mean absolute error\n"
             "  rmse      the root of the mean square error\n"
             "  max       the largest error, and where it is\n"
             "  bias      the mean of B minus A\n"
             "  mse       the mean square error\n"
             "  psnr      the peak signal-to-noise ratio\n"
             "  ws-psnr   the same by solid angle; equirectangular images, 2:1\n"
             "  s-psnr    the same at 655362 even points, their pixels; also 2:1\n"
             "  ssim      structural similarity, mean over the channels; 1 is alike\n"
             "  flip      what is seen when A and B take turns, 0 to 1; integers are sRGB,\n"
             "            other images linear light from 0 to 1\n"
             "  hdr-flip  the greatest FLIP over exposures of linear light in floats\n"
             "\n"
             "Examples:\n"
             "  cubemap-compare --max-rmse 2.5 earth.png earth-again.png\n"
             "  cubemap-compare --surface 'cube:coupled;layout=cross' --measure ws-psnr \\\n"
             "      earth.png cross.png\n"
             "  cubemap-compare earth.png face_%f.png",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};
