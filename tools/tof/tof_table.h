/* SPDX-License-Identifier: MIT
 *
 * What the options of cubemap-tof are called in its source, and its commands.
 */
#ifndef CUBEMAP_TOOLS_TOF_TABLE_H
#define CUBEMAP_TOOLS_TOF_TABLE_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Virtual lights, and paths a pixel, that a simulation takes. */
#define TOF_LIGHTS_MOST 1048576
#define TOF_PATHS_MOST TOF_LIGHTS_MOST

enum
{
    TOF_OUTPUT = 1,
    TOF_PRESET,
    TOF_BOUNCES,
    TOF_LIGHTS,
    TOF_VISIBILITY,
    TOF_SAMPLES,
    TOF_FULL,
    TOF_NOISE,
    TOF_SEED,
    TOF_BUDGET,
    TOF_TRUTH,
    TOF_THREADS,
    TOF_JSON,
    TOF_QUIET,
    TOF_CONFIDENCE,
    TOF_FORMAT,
    TOF_FIELD,
    TOF_SIZE,
    TOF_DEPTHS,
    TOF_WINDOW,
    TOF_RAYS,
    TOF_SPACING,
    TOF_SHOT,
    TOF_ENVIRONMENT,
    TOF_ENVIRONMENT_SURFACE,
    TOF_PATHS_A_PIXEL
};

/* The sensors that are built in, up to NULL. */
extern const char *const tof_preset_names[];

/* What --format may be, in this order, up to NULL. */
enum
{
    TOF_FORMAT_EXR,
    TOF_FORMAT_NPY,
    TOF_FORMAT_HDF5
};
extern const char *const tof_format_names[];

/* What --shot may be: the names of CM_TOF_POISSON and CM_TOF_FREEMAN_TUKEY, up to NULL. */
extern const char *const tof_shot_names[];

extern const cm_command tof_simulate_command;
extern const cm_command tof_reproduce_command;
extern const cm_command tof_evaluate_command;
extern const cm_command tof_texel_command;

#ifdef __cplusplus
}
#endif

#endif
