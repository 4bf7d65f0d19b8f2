/* SPDX-License-Identifier: MIT */
#include "scene_table.h"
#include "scene_main.h"

#include "tools/cli/usual_options.h"

#define OUTPUT                                                                                     \
    {                                                                                              \
        .id = SCENE_OUTPUT, .letter = 'o', .name = "output", .kind = CM_OPTION_FILE,               \
        .argument = "DIR", .help = "the folder to write, which must be absent or empty",           \
        .more = "It appears when all of it is there."                                              \
    }
#define CAMERA                                                                                     \
    {                                                                                              \
        .id = SCENE_CAMERA, .name = "camera", .kind = CM_OPTION_FILE, .argument = "FILE",          \
        .help = "the camera, in place of camera.json in the folder"                                \
    }
#define JSON                                                                                       \
    {                                                                                              \
        .id = SCENE_JSON, .name = "json", .help = "print the result as JSON"                       \
    }

static const char *const layouts[] = {"tum", "open3d", "7scenes", NULL};

static const cm_option render_options[] = {
    OUTPUT,
    {.id = SCENE_NOISE,
     .name = "noise",
     .kind = CM_OPTION_TEXT,
     .argument = "gaussian:S",
     .help = "noise along the ray, whose standard deviation is S times the range",
     .more = "S is from 0 to 1. What is not above 0 then counts as not measured."},
    {.id = SCENE_SEED,
     .name = "seed",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "of the noise, which depends on seed, view and pixel alone",
     .standard = "0",
     .low = 0,
     .high = 2147483647},
    {.id = SCENE_TRUTH,
     .name = "truth",
     .help = "add a folder of truth, a TIME.exr for each view: depth, range, position, normal, id, "
             "and the flow to the next view "
             "and to the one before",
     .more =
         "Floats without noise. Position and normal are in the world's axes. The flow leads "
         "from a pixel to where its point is in the other view: column and row there less those "
         "here; it is NaN where that view does not see the point. Where a ray meets nothing, "
         "all are NaN and the id is -1."},
    CM_USUAL_THREADS(SCENE_THREADS),
    CM_USUAL_QUIET(SCENE_QUIET),
};

static const cm_option info_options[] = {CAMERA, JSON};

static const cm_option convert_options[] = {
    OUTPUT,
    {.id = SCENE_TO,
     .name = "to",
     .kind = CM_OPTION_CHOICE,
     .argument = "LAYOUT",
     .help = "how the files are to lie",
     .choices = layouts},
    CAMERA,
    CM_USUAL_QUIET(SCENE_QUIET),
};

static const cm_option evaluate_options[] = {JSON};

static const cm_option_group render_groups[] = {
    {NULL, render_options, sizeof render_options / sizeof *render_options}};
static const cm_option_group info_groups[] = {
    {NULL, info_options, sizeof info_options / sizeof *info_options}};
static const cm_option_group convert_groups[] = {
    {NULL, convert_options, sizeof convert_options / sizeof *convert_options}};
static const cm_option_group evaluate_groups[] = {
    {NULL, evaluate_options, sizeof evaluate_options / sizeof *evaluate_options}};

const cm_command scene_render_command = {
    .name = "cubemap-scene render",
    .usage = "[OPTION]... SCENE CAMERA.json TRAJECTORY.txt -o DIR",
    .summary =
        "Renders what a camera sees along a trajectory into a folder as TUM has it: camera.json, "
        "depth.txt and depth/TIME.png, 16 bits, rgb.txt and rgb/TIME.png, unlit, groundtruth.txt. "
        "SCENE is `room`, `corridor` or `spheres`, a mesh (.gltf, .glb, .obj), or a .json of "
        "planes, "
        "boxes, spheres, cylinders and meshes. TRAJECTORY.txt has lines `time tx ty tz qx qy qz "
        "qw`, "
        "camera to world.",
    .groups = render_groups,
    .group_count = 1,
    .notes = "Example:\n"
             "  cubemap-scene render room camera.json path.txt -o made --truth",
    .words = "SCENE DIR TIME",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

const cm_command scene_info_command = {
    .name = "cubemap-scene info",
    .usage = "[OPTION]... DIR",
    .summary =
        "Tells what a sequence has: views, what is listed and absent, its camera, times, and "
        "statistics of depth in metres.",
    .groups = info_groups,
    .group_count = 1,
    .words = "DIR",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

const cm_command scene_convert_command = {.name = "cubemap-scene convert",
                                          .usage = "[OPTION]... DIR --to LAYOUT -o DIR2",
                                          .summary = "Writes a sequence in another layout.",
                                          .groups = convert_groups,
                                          .group_count = 1,
                                          .words = "DIR DIR2 LAYOUT",
                                          .operand = CM_OPTION_FILE,
                                          .bare_version = 1};

const cm_command scene_evaluate_command = {
    .name = "cubemap-scene evaluate",
    .usage = "[OPTION]... TRUTH.txt ESTIMATE.txt",
    .summary =
        "Measures a trajectory against the true one: pairs of stamps at most 0.02 s apart, the "
        "closest first; ATE, the root mean square of distances after the best rigid motion; RPE, "
        "that of the error of motions over 1 s.",
    .groups = evaluate_groups,
    .group_count = 1,
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

static const cm_command *const commands[] = {&scene_render_command, &scene_info_command,
                                             &scene_convert_command, &scene_evaluate_command, NULL};

static const char *const command_names[] = {"render", "info", "convert", "evaluate", NULL};

/* --help and --version alone */
static const cm_option_group scene_groups[] = {{NULL, NULL, 0}};

const cm_command cm_scene_command = {
    .name = "cubemap-scene",
    .usage = "render [OPTION]... SCENE CAMERA.json TRAJECTORY.txt -o DIR\n"
             "info [OPTION]... DIR\n"
             "convert [OPTION]... DIR --to LAYOUT -o DIR2\n"
             "evaluate [OPTION]... TRUTH.txt ESTIMATE.txt",
    .summary = "Sequences of depth cameras: renders them with their truth, tells what they have, "
               "converts them, and measures trajectories. Each command has a --help of its own.",
    .groups = scene_groups,
    .group_count = 1,
    .words = "SCENE DIR DIR2 LAYOUT",
    .operand = CM_OPTION_TEXT,
    .choices = command_names,
    .commands = commands,
    .bare_version = 1};
