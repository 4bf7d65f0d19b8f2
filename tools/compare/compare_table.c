/* SPDX-License-Identifier: MIT */
#include "compare_main.h"
#include "compare_table.h"

#include <math.h>

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
};

static const cm_option_group groups[] = {{NULL, options, sizeof options / sizeof *options}};

const cm_command cm_compare_command = {
    .name = "cubemap-compare",
    .usage = "[OPTION]... A B",
    .summary =
        "Prints how far image B is from image A, over all pixels and channels: the mean absolute "
        "error, the root of the mean square error, the largest error and where it is, and the peak "
        "signal-to-noise ratio. Both must be of the same size and have the same number of "
        "channels.\n\n"
        "If both hold integers, errors are in grey levels of 8 bits (0 to 255) and the peak is "
        "255; otherwise errors are in the images' own unit and the peak is 1. Where both hold the "
        "same infinity, or both a NaN, there is no error; where one holds what is not a finite "
        "number, the error is infinite.",
    .groups = groups,
    .group_count = 1,
    .notes = "Example:\n"
             "  cubemap-compare --max-rmse 2.5 earth.png earth-again.png",
    .operand = CM_OPTION_FILE,
    .bare_version = 1};
