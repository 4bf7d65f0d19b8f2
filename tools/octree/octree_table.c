/* SPDX-License-Identifier: MIT */
#include "octree_table.h"
#include "octree_main.h"

#include "tools/cli/usual_options.h"

#include <cubemap/octree.h>

#include <math.h>

#define MAP_OUTPUT(what)                                                                           \
    {                                                                                              \
        .id = OCTREE_OUTPUT, .letter = 'o', .name = "output", .kind = CM_OPTION_FILE,              \
        .argument = "MAP", .help = what                                                            \
    }
#define EDGE(words)                                                                                \
    {                                                                                              \
        .id = OCTREE_EDGE, .name = "edge", .kind = CM_OPTION_NUMBER, .argument = "LENGTH",         \
        .help = "the edge of the finest voxel" words, .standard = "0.01", .low = 0,                \
        .high = INFINITY, .flags = CM_OPTION_ABOVE                                                 \
    }
#define CENTRE                                                                                     \
    {                                                                                              \
        .id = OCTREE_CENTRE, .name = "centre", .kind = CM_OPTION_TEXT, .argument = "X,Y,Z",        \
        .help = "the centre of the map", .standard = "0,0,0"                                       \
    }
#define LEVELS                                                                                     \
    {                                                                                              \
        .id = OCTREE_LEVELS, .name = "levels", .kind = CM_OPTION_WHOLE, .argument = "N",           \
        .help = "the map has 2 to the power of N voxels each way", .standard = "16", .low = 1,     \
        .high = CM_OCTREE_LEVELS_MAX                                                               \
    }
#define MEMORY                                                                                     \
    {                                                                                              \
        .id = OCTREE_MEMORY, .name = "memory", .kind = CM_OPTION_TEXT, .argument = "SIZE",         \
        .help = "what the map may take of memory, such as 256M or 2G; a number alone is M; the "   \
                "rest of it stays in its file, and is read where it is needed",                    \
        .more = "Units are K, M, G and T of 1024 each.", .standard = "no limit"                    \
    }
#define FAR(words)                                                                                 \
    {                                                                                              \
        .id = OCTREE_FAR, .name = "far", .kind = CM_OPTION_NUMBER, .argument = "LENGTH",           \
        .help = words, .standard = "no limit", .low = 0, .high = INFINITY,                         \
        .flags = CM_OPTION_ABOVE                                                                   \
    }
#define LEVEL                                                                                      \
    {                                                                                              \
        .id = OCTREE_LEVEL, .name = "level", .kind = CM_OPTION_WHOLE, .argument = "N",             \
        .help = "the level of the voxels: 0 is the finest", .standard = "0", .low = 0,             \
        .high = CM_OCTREE_LEVELS_MAX                                                               \
    }
#define LIGHT                                                                                      \
    {                                                                                              \
        .id = OCTREE_LIGHT, .name = "light", .kind = CM_OPTION_TEXT, .argument = "X,Y,Z",          \
        .help = "a light there, whose shadow is traced, in place of the colours as they are"       \
    }
#define CAMERA                                                                                     \
    {                                                                                              \
        .id = OCTREE_CAMERA, .name = "camera", .kind = CM_OPTION_FILE, .argument = "FILE",         \
        .help = "the camera, in place of camera.json in the folder"                                \
    }
#define JSON                                                                                       \
    {                                                                                              \
        .id = OCTREE_JSON, .name = "json", .help = "print the result as JSON"                      \
    }

static const char *const formats[] = {"xyz", "ply", "vdb", NULL};
static const char *const outsides[] = {"survives", "dies", NULL};

static const cm_option integrate_options[] = {
    MAP_OUTPUT("the map to write, which keeps what was committed if the program is killed; then "
               "the same command goes on from there"),
    EDGE(", in the unit of the views"),
    {.id = OCTREE_COLOR, .name = "color", .help = "voxels have colours"},
    {.id = OCTREE_FOOTPRINT,
     .name = "footprint",
     .kind = CM_OPTION_NUMBER,
     .argument = "PIXELS",
     .help = "voxels are no finer than so many pixels where they were seen from, up to 8 edges",
     .standard = "0, one size",
     .low = 0,
     .high = 64},
    MEMORY,
    {.id = OCTREE_NOISE,
     .name = "noise",
     .kind = CM_OPTION_NUMBER,
     .argument = "PART",
     .help = "noise of the sensor, its standard deviation as a part of the range",
     .standard = "0",
     .low = 0,
     .high = 1},
    {.id = OCTREE_NEAR,
     .name = "near",
     .kind = CM_OPTION_NUMBER,
     .argument = "LENGTH",
     .help = "depths that are nearer say nothing; ranges of whole surroundings",
     .standard = "0",
     .low = 0,
     .high = INFINITY},
    FAR("depths that are farther are no surface; the map is free up to here"),
    {.id = OCTREE_NO_RETURN_FREE,
     .name = "no-return-free",
     .help = "where a pixel measured nothing it is free up to --far, which is needed"},
    {.id = OCTREE_ENDPOINTS_ONLY,
     .name = "endpoints-only",
     .help = "no space becomes free, and what moves away stays: takes less time and memory"},
    {.id = OCTREE_LOG_ODDS,
     .name = "log-odds",
     .kind = CM_OPTION_TEXT,
     .argument = "HIT,MISS,LOW,HIGH",
     .help = "what a hit adds, above 0, and a miss, below 0, and the bounds",
     .standard = "counts: 64 misses make what is surely occupied unknown"},
    {.id = OCTREE_BUDGET,
     .name = "budget",
     .kind = CM_OPTION_NUMBER,
     .argument = "LENGTH",
     .help = "how far the surface may be from where it is: the coarsest voxels that keep it are "
             "taken, from --edge on, and the result says what each saving saved",
     .low = 0,
     .high = INFINITY,
     .flags = CM_OPTION_ABOVE},
    CENTRE,
    LEVELS,
    CAMERA,
    {.id = OCTREE_SAVE_EVERY,
     .name = "save-every",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "commit the map to its file after so many views",
     .standard = "0, about every 5 seconds",
     .low = 0,
     .high = 1e9},
    CM_USUAL_THREADS(OCTREE_THREADS),
    JSON,
    CM_USUAL_QUIET(OCTREE_QUIET),
};

static const cm_option query_options[] = {LEVEL, MEMORY};

static const cm_option ray_options[] = {FAR("how far rays go"), MEMORY};

static const cm_option extract_options[] = {
    {.id = OCTREE_OUTPUT,
     .letter = 'o',
     .name = "output",
     .kind = CM_OPTION_FILE,
     .argument = "OUT",
     .help = "the file to write; - is standard output, for xyz"},
    LEVEL,
    {.id = OCTREE_FORMAT,
     .name = "format",
     .kind = CM_OPTION_CHOICE,
     .argument = "FORMAT",
     .help = "xyz: lines x y z EDGE R G B; ply: points with colours; vdb: grids of OpenVDB",
     .standard = "as OUT ends, or xyz",
     .choices = formats},
    MEMORY,
};

static const cm_option render_options[] = {
    {.id = OCTREE_OUTPUT,
     .letter = 'o',
     .name = "output",
     .kind = CM_OPTION_FILE,
     .argument = "VIEW",
     .help = "the picture to write"},
    {.id = OCTREE_DEPTH,
     .name = "depth",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "write the depth, too, as floats, NaN where nothing is met"},
    LIGHT,
    {.id = OCTREE_MESH,
     .name = "mesh",
     .kind = CM_OPTION_FILE,
     .argument = "FILE",
     .help = "a mesh (.gltf, .glb, .obj) that stands in the map, hides and is hidden"},
    {.id = OCTREE_MESH_POSE,
     .name = "mesh-pose",
     .kind = CM_OPTION_FILE,
     .argument = "POSE.txt",
     .help = "how the mesh stands, from mesh to world",
     .standard = "as its file has it"},
    LEVEL,
    FAR("how far is looked"),
    MEMORY,
    CM_USUAL_THREADS(OCTREE_THREADS),
};

static const cm_option probe_options[] = {
    {.id = OCTREE_OUTPUT,
     .letter = 'o',
     .name = "output",
     .kind = CM_OPTION_FILE,
     .argument = "PROBE",
     .help = "the pictures to write, with %f in place of the face's number"},
    {.id = OCTREE_AT,
     .name = "at",
     .kind = CM_OPTION_TEXT,
     .argument = "X,Y,Z",
     .help = "where the probe is"},
    {.id = OCTREE_TO,
     .name = "to",
     .kind = CM_OPTION_TEXT,
     .argument = "SURFACE",
     .help = "how the sphere lies on the pictures: a cube of any mapping, or one square",
     .standard = "`cube:coupled`"},
    {.id = OCTREE_SIZE,
     .name = "size",
     .kind = CM_OPTION_WHOLE,
     .argument = "N",
     .help = "the edge of a face in pixels",
     .standard = "128",
     .low = 1,
     .high = 16384},
    LIGHT,
    LEVEL,
    FAR("how far is looked"),
    MEMORY,
    CM_USUAL_THREADS(OCTREE_THREADS),
};

static const cm_option merge_options[] = {
    MAP_OUTPUT("the map to write"),
    {.id = OCTREE_POSE,
     .name = "pose",
     .kind = CM_OPTION_FILE,
     .argument = "POSE.txt",
     .help = "takes points of B to points of A",
     .standard = "none: the axes are the same, and counts add exactly"},
    JSON,
};

static const cm_option hull_options[] = {
    MAP_OUTPUT("the map to write"),
    EDGE(", in the unit of the views"),
    CENTRE,
    LEVELS,
    {.id = OCTREE_OUTSIDE,
     .name = "outside",
     .kind = CM_OPTION_CHOICE,
     .argument = "WHAT",
     .help = "what becomes of a voxel that a view does not see",
     .standard = "`survives`",
     .choices = outsides},
    CAMERA,
    CM_USUAL_THREADS(OCTREE_THREADS),
    JSON,
    CM_USUAL_QUIET(OCTREE_QUIET),
};

static const cm_option info_options[] = {JSON, MEMORY};

#define GROUP(name)                                                                                \
    static const cm_option_group name##_groups[] = {                                               \
        {NULL, name##_options, sizeof name##_options / sizeof *name##_options}}

GROUP(integrate);
GROUP(query);
GROUP(ray);
GROUP(extract);
GROUP(render);
GROUP(probe);
GROUP(merge);
GROUP(hull);
GROUP(info);

const cm_command octree_integrate_command = {
    .name = "cubemap-octree integrate",
    .usage = "[OPTION]... DIR -o MAP",
    .summary =
        "Makes a map of a sequence of depth views: a folder as cubemap-scene writes it, or - for a "
        "stream. What was seen is occupied, what was looked through is free, all else unknown. A "
        "map that is there is written anew; one that a killed run of the same command has left is "
        "gone on with.",
    .groups = integrate_groups,
    .group_count = 1,
    .notes = "Example:\n"
             "  cubemap-octree integrate room -o room.map --edge 0.01 --color --json",
    .words = "DIR MAP",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

const cm_command octree_query_command = {
    .name = "cubemap-octree query",
    .usage = "[OPTION]... MAP",
    .summary =
        "Reads lines `x y z` from standard input and writes for each what is there: `unknown`, "
        "`free` or `occupied`, the voxel's EDGE, and its colour R G B, 0 to 255, or 0 0 0 where it "
        "has none. EDGE is 0 outside of the map. Blank lines and comments, from # on, are passed "
        "through.",
    .groups = query_groups,
    .group_count = 1,
    .words = "MAP EDGE R G B",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

const cm_command octree_ray_command = {
    .name = "cubemap-octree ray",
    .usage = "[OPTION]... MAP",
    .summary =
        "Reads lines `ox oy oz dx dy dz` from standard input, origin and direction, and writes for "
        "each the DISTANCE to the first occupied voxel and its colour R G B, or `none`.",
    .groups = ray_groups,
    .group_count = 1,
    .words = "MAP DISTANCE R G B",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

const cm_command octree_extract_command = {
    .name = "cubemap-octree extract",
    .usage = "[OPTION]... MAP -o OUT",
    .summary = "Writes the occupied voxels of a level, in the order of their keys.",
    .groups = extract_groups,
    .group_count = 1,
    .words = "MAP OUT EDGE R G B",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

const cm_command octree_render_command = {
    .name = "cubemap-octree render",
    .usage = "[OPTION]... MAP CAMERA.json POSE.txt -o VIEW",
    .summary =
        "Draws what a camera would see of a map, by a cone for each pixel. CAMERA.json is as "
        "cubemap-scene has it, POSE.txt has one line `time tx ty tz qx qy qz qw`, camera to world.",
    .groups = render_groups,
    .group_count = 1,
    .words = "MAP VIEW",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

const cm_command octree_probe_command = {
    .name = "cubemap-octree probe",
    .usage = "[OPTION]... MAP --at X,Y,Z -o PROBE",
    .summary = "Draws what is around a place of a map, on the faces of any mapping.",
    .groups = probe_groups,
    .group_count = 1,
    .notes = "Example:\n"
             "  cubemap-octree probe room.map --at 0,0,1.2 --to cube:coupled -o probe_%f.exr",
    .words = "MAP PROBE",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

const cm_command octree_merge_command = {
    .name = "cubemap-octree merge",
    .usage = "[OPTION]... A B -o MAP",
    .summary = "Adds the counts of map B to those of map A: what both have seen together.",
    .groups = merge_groups,
    .group_count = 1,
    .words = "A B MAP",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

const cm_command octree_hull_command = {
    .name = "cubemap-octree hull",
    .usage = "[OPTION]... DIR -o MAP",
    .summary =
        "Carves the visual hull of masks, which are the colours of a sequence, not 0 inside, "
        "whatever alpha says: what all of them have inside is occupied, the rest free. The "
        "sequence needs no depth.",
    .groups = hull_groups,
    .group_count = 1,
    .words = "DIR MAP",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};

const cm_command octree_info_command = {.name = "cubemap-octree info",
                                        .usage = "[OPTION]... MAP",
                                        .summary = "Tells how a map was made and what it holds.",
                                        .groups = info_groups,
                                        .group_count = 1,
                                        .words = "MAP",
                                        .operand = CM_OPTION_FILE,
                                        .bare_version = 1};

static const cm_command *const commands[] = {&octree_integrate_command, &octree_query_command,
                                             &octree_ray_command,       &octree_extract_command,
                                             &octree_render_command,    &octree_probe_command,
                                             &octree_merge_command,     &octree_hull_command,
                                             &octree_info_command,      NULL};

static const char *const command_names[] = {"integrate", "query", "ray",  "extract", "render",
                                            "probe",     "merge", "hull", "info",    NULL};

/* --help and --version alone */
static const cm_option_group octree_groups[] = {{NULL, NULL, 0}};

const cm_command cm_octree_command = {
    .name = "cubemap-octree",
    .usage = "integrate [OPTION]... DIR -o MAP\n"
             "query [OPTION]... MAP\n"
             "ray [OPTION]... MAP\n"
             "extract [OPTION]... MAP -o OUT\n"
             "render [OPTION]... MAP CAMERA.json POSE.txt -o VIEW\n"
             "probe [OPTION]... MAP --at X,Y,Z -o PROBE\n"
             "merge [OPTION]... A B -o MAP\n"
             "hull [OPTION]... DIR -o MAP\n"
             "info [OPTION]... MAP",
    .summary =
        "Maps of scenes from depth views: makes them, asks them, draws them, merges them. A MAP is "
        "a file of this program; where one is read it may be a .bt or .ot of OctoMap, too. Each "
        "command has a --help of its own.",
    .groups = octree_groups,
    .group_count = 1,
    .words = "DIR MAP OUT VIEW PROBE A B",
    .operand = CM_OPTION_TEXT,
    .choices = command_names,
    .commands = commands,
    .bare_version = 1};
