/* SPDX-License-Identifier: MIT */
#include "tof_table.h"
#include "tof_main.h"

#include "tools/cli/usual_options.h"

const char *const tof_preset_names[] = {"pico-flexx", "camcube", "dual-12um", "single-8um", NULL};
const char *const tof_format_names[] = {"exr", "npy", "hdf5", NULL};
const char *const tof_shot_names[] = {"poisson", "freeman-tukey", NULL};

/* Of commands that write a folder. */
#define TOF_FOLDER                                                                                 \
    {                                                                                              \
        .id = TOF_OUTPUT, .letter = 'o', .name = "output", .kind = CM_OPTION_FILE,                 \
        .argument = "DIR", .help = "the folder to write, which is made if it is absent"            \
    }

static const cm_option simulate_options[] = {
    {.id = TOF_OUTPUT,
     .letter = 'o',
     .name = "output",
     .kind = CM_OPTION_FILE,
     .argument = "DIR",
     .help =
         "the folder to write, which is made if it is absent; files of the same names are replaced",
     .more =
         "The files of a frame appear together, when all of them are complete; poses.txt appears "
         "with the last. `-` writes frames to standard output as they are made, as arrays of NPY."},
    {.id = TOF_PRESET,
     .name = "preset",
     .kind = CM_OPTION_CHOICE,
     .argument = "NAME",
     .help = "a camera that is built in, in place of SENSOR.json",
     .choices = tof_preset_names},
    {.id = TOF_BOUNCES,
     .name = "bounces",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help =
         "how often light is scattered on its way, beyond the surface that is seen: 1 by virtual "
         "lights, more by paths",
     .standard = "0, direct light",
     .low = 0,
     .high = 1000},
    {.id = TOF_LIGHTS,
     .name = "lights",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "virtual lights of one bounce",
     .standard = "338",
     .low = 1,
     .high = TOF_LIGHTS_MOST},
    {.id = TOF_VISIBILITY, .name = "visibility", .help = "virtual lights cast shadows"},
    {.id = TOF_PATHS_A_PIXEL,
     .name = "paths",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help =
         "paths a pixel along which scattered light is followed, of one bounce, too; and rays a "
         "pixel to the surroundings",
     .standard = "virtual lights for one bounce, 64 paths for more",
     .low = 1,
     .high = TOF_PATHS_MOST},
    {.id = TOF_SAMPLES,
     .name = "samples",
     .kind = CM_OPTION_TEXT,
     .argument = "COLUMNSxROWS",
     .help = "samples of a pixel, where it sees edges",
     .more = "Each is from 1 to 64.",
     .standard = "1x1"},
    {.id = TOF_FULL, .name = "full", .help = "take all samples in all pixels"},
    {.id = TOF_NOISE,
     .name = "noise",
     .help = "shot noise, and the dark, read and fixed pattern noise that the sensor has"},
    {.id = TOF_SHOT,
     .name = "shot",
     .kind = CM_OPTION_CHOICE,
     .argument = "NAME",
     .help =
         "where shot noise comes from: Poisson's distribution; or normal numbers in Freeman and "
         "Tukey's space, of a variance by a polynomial (Bulczak, Lambers and Kolb 2018)",
     .more = "The polynomial is the sensor's shot_variance, or Poisson's own.",
     .standard = "poisson",
     .choices = tof_shot_names},
    {.id = TOF_SEED,
     .name = "seed",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "of all random numbers, which depend on seed, frame and pixel alone",
     .standard = "0",
     .low = 0,
     .high = 2147483647},
    {.id = TOF_ENVIRONMENT,
     .name = "environment",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help =
         "light from all around, not modulated: a picture of the sphere in the world's axes, in "
         "W/(m^2 sr)",
     .more =
         "Of colours the mean counts; whole numbers stand for 0 to 1. A picture of faces is taken "
         "texel by texel, each other one is resampled to a cube."},
    {.id = TOF_ENVIRONMENT_SURFACE,
     .name = "environment-surface",
     .kind = CM_OPTION_TEXT,
     .argument = "SPEC",
     .help = "how the sphere lies on that picture, as cubemap-reproject has it in one image: "
             "`cube:coupled;layout=cross`",
     .standard = "`equirect`, if it is 2:1"},
    {.id = TOF_BUDGET,
     .name = "budget",
     .kind = CM_OPTION_TEXT,
     .argument = "LENGTH",
     .help =
         "measure in the first frame what each effect does to the distance, simulate those that "
         "are needed for an error of at most this, and tell all of them",
     .more =
         "LENGTH is in metres, or ends with m, cm, mm or um: `1mm`. Bounces, visibility, noise, "
         "samples, virtual lights and paths are then chosen. --bounces, --samples, --lights and "
         "--paths are not exceeded; without them there are up to 4 bounces, 3x3 samples, 5408 "
         "lights and 4096 paths, as many as the light's own spread needs. What remains beyond the "
         "limit is told by name."},
    {.id = TOF_TRUTH,
     .name = "truth",
     .help = "write truth_FRAME.exr, too: what is truly there",
     .more =
         "It is an OpenEXR file of parts: position and normal in the world; object, shape and "
         "triangle as whole numbers; depth and range; flow_next and flow_before in columns, rows "
         "and metres; effects, masks of flying, motion, multipath, nothing and saturated."},
    {.id = TOF_FORMAT,
     .name = "format",
     .kind = CM_OPTION_CHOICE,
     .argument = "NAME",
     .help = "what files are of: OpenEXR; arrays of NumPy, one a file; or HDF5, one file a frame",
     .more = "Arrays are of rows and columns, phases and coordinates before them: phase, distance, "
             "amplitude, intensity, flags (1 saturated, 2 nothing, 4 flying, 8 motion, 16 "
             "multipath), and with --truth what it has, positions in double precision.",
     .standard = "exr; npy for -o -",
     .choices = tof_format_names},
    CM_USUAL_THREADS(TOF_THREADS),
    {.id = TOF_JSON, .name = "json", .help = "print the result as JSON"},
    CM_USUAL_QUIET(TOF_QUIET),
};

static const cm_option_group simulate_groups[] = {
    {NULL, simulate_options, sizeof simulate_options / sizeof *simulate_options}};

const cm_command tof_simulate_command = {
    .name = "cubemap-tof simulate",
    .usage = "[OPTION]... SCENE SENSOR.json TRAJECTORY.txt -o DIR\n"
             "--preset NAME [OPTION]... SCENE PATH.txt -o DIR",
    .summary =
        "Simulates what a time-of-flight camera measures, to the electron. SCENE is as "
        "cubemap-scene has it. SENSOR.json has the camera, its sensor and its lights, in SI units. "
        "Each line of TRAJECTORY.txt, `time tx ty tz qx qy qz qw`, camera to world, begins a "
        "frame; "
        "between lines the camera moves, before the first and after the last it stands. DIR gets "
        "for each frame phase_FRAME_PHASE.exr (electrons), distance_FRAME.exr (range in metres), "
        "amplitude_FRAME.exr and intensity_FRAME.exr, with --truth truth_FRAME.exr, and once "
        "metadata.json and poses.txt.",
    .groups = simulate_groups,
    .group_count = 1,
    .notes = "Example:\n"
             "  cubemap-tof simulate --preset pico-flexx --noise room path.txt -o made",
    .words = "SCENE DIR FRAME PHASE NAME COLUMNS ROWS LENGTH FILE SPEC",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

static const cm_option evaluate_options[] = {
    {.id = TOF_CONFIDENCE,
     .name = "confidence",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "how sure each pixel is, such as amplitude_0000.exr: its sparsification is told, the "
             "error "
             "of what is left when the least sure pixels are removed, beside the best there is"},
    {.id = TOF_OUTPUT,
     .letter = 'o',
     .name = "output",
     .kind = CM_OPTION_FILE,
     .argument = "DIR",
     .help = "a folder for the plot of --confidence, sparsification.json, and PNG and SVG where "
             "Python has matplotlib; it is made if it is absent"},
    {.id = TOF_JSON, .name = "json", .help = "print all measures as JSON"},
};

static const cm_option_group evaluate_groups[] = {
    {NULL, evaluate_options, sizeof evaluate_options / sizeof *evaluate_options}};

const cm_command tof_evaluate_command = {
    .name = "cubemap-tof evaluate",
    .usage = "[OPTION]... MEASURED.exr TRUTH.exr",
    .summary =
        "Measures how far distances are from the truth, metres along the ray. TRUTH.exr may be one "
        "that simulate --truth has written, or any picture of distances; NaN and 0 are not "
        "measured.",
    .groups = evaluate_groups,
    .group_count = 1,
    .notes = "Example:\n"
             "  cubemap-tof evaluate made/distance_0000.exr made/truth_0000.exr --json",
    .words = "MEASURED TRUTH",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

static const char *const spacing_names[] = {"spaces", "angles", NULL};

static const cm_option texel_options[] = {
    TOF_FOLDER,
    {.id = TOF_FIELD,
     .name = "field",
     .kind = CM_OPTION_NUMBER,
     .argument = "DEGREES",
     .help = "from the left edge to the right",
     .standard = "60",
     .low = 0.001,
     .high = 179},
    {.id = TOF_SIZE,
     .name = "size",
     .kind = CM_OPTION_WHOLE,
     .argument = "PIXELS",
     .help = "of the colours, each way",
     .standard = "1024",
     .low = 1,
     .high = 16384},
    {.id = TOF_DEPTHS,
     .name = "depths",
     .kind = CM_OPTION_WHOLE,
     .argument = "COUNT",
     .help = "depths each way, no more than pixels",
     .standard = "a sixteenth of the pixels",
     .low = 1,
     .high = 16384},
    {.id = TOF_WINDOW,
     .name = "window",
     .kind = CM_OPTION_WHOLE,
     .argument = "PIXELS",
     .help = "each way, no more than all, of which a depth is the mean",
     .standard = "16",
     .low = 1,
     .high = 16384},
    {.id = TOF_RAYS,
     .name = "rays",
     .kind = CM_OPTION_WHOLE,
     .argument = "COUNT",
     .help = "through a pixel, each way",
     .standard = "1",
     .low = 1,
     .high = 16},
    {.id = TOF_SPACING,
     .name = "spacing",
     .kind = CM_OPTION_CHOICE,
     .argument = "NAME",
     .help = "what is alike between depths: spaces on a wall, or angles",
     .standard = "spaces",
     .choices = spacing_names},
    CM_USUAL_THREADS(TOF_THREADS),
    CM_USUAL_QUIET(TOF_QUIET),
};

static const cm_option_group texel_groups[] = {
    {NULL, texel_options, sizeof texel_options / sizeof *texel_options}};

const cm_command tof_texel_command = {
    .name = "cubemap-tof texel",
    .usage = "[OPTION]... SCENE PATH.txt -o DIR",
    .summary =
        "Renders texel images: a fine picture of colours over a coarse cloud of depths behind one "
        "lens (Killpack 2016, chapter 3). DIR gets for each line of PATH.txt, `time tx ty tz qx qy "
        "qz qw`, camera to world, color_FRAME.exr, depth_FRAME.exr, range_FRAME.exr and "
        "point_FRAME.exr (X, Y, Z in the camera's axes), in metres, and once matrices.txt: sixteen "
        "numbers a line, by rows, that take points to the axes of the first line's camera.",
    .groups = texel_groups,
    .group_count = 1,
    .notes = "Example:\n"
             "  cubemap-tof texel room path.txt -o made --spacing angles",
    .words = "SCENE DIR PATH FRAME NAME DEGREES PIXELS COUNT X Y Z",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

static const cm_option reproduce_options[] = {
    TOF_FOLDER,
    CM_USUAL_THREADS(TOF_THREADS),
    CM_USUAL_QUIET(TOF_QUIET),
};

static const cm_option_group reproduce_groups[] = {
    {NULL, reproduce_options, sizeof reproduce_options / sizeof *reproduce_options}};

const cm_command tof_reproduce_command = {
    .name = "cubemap-tof reproduce",
    .usage = "[OPTION]... [NAME]... -o DIR",
    .summary =
        "Does again what papers on time-of-flight cameras have measured, and says beside each "
        "figure what came out here and whether it holds. NAME is exact (what formulas say), "
        "layouts and resolution (Lambers, Hoberg and Kolb 2015), multipath (Bulczak, Lambers and "
        "Kolb 2018), lens (Lambers, Sommerhoff and Kolb 2018) or motion (Steiner and others 2019); "
        "all without one. The last two need OpenCV. DIR gets NAME.json with all numbers, "
        "report.md, "
        "and charts as PNG and SVG where Python has matplotlib.",
    .groups = reproduce_groups,
    .group_count = 1,
    .notes = "Example:\n"
             "  cubemap-tof reproduce exact -o made",
    .words = "NAME DIR",
    .operand = CM_OPTION_TEXT,
    .bare_version = 1};

static const cm_command *const commands[] = {&tof_simulate_command, &tof_evaluate_command,
                                             &tof_texel_command, &tof_reproduce_command, NULL};

static const char *const command_names[] = {"simulate", "evaluate", "texel", "reproduce", NULL};

/* --help and --version alone */
static const cm_option_group tof_groups[] = {{NULL, NULL, 0}};

const cm_command cm_tof_command = {
    .name = "cubemap-tof",
    .usage = "simulate [OPTION]... SCENE SENSOR.json TRAJECTORY.txt -o DIR\n"
             "evaluate [OPTION]... MEASURED.exr TRUTH.exr\n"
             "texel [OPTION]... SCENE PATH.txt -o DIR\n"
             "reproduce [OPTION]... [NAME]... -o DIR",
    .summary = "Time-of-flight cameras: simulates what they measure, tells how good that is, "
               "renders texel images, and does again what papers "
               "found. Each command has a --help of its "
               "own.",
    .groups = tof_groups,
    .group_count = 1,
    .words = "SCENE DIR MEASURED TRUTH NAME PATH",
    .operand = CM_OPTION_TEXT,
    .choices = command_names,
    .commands = commands,
    .bare_version = 1};
