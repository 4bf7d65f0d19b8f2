/* SPDX-License-Identifier: MIT
 *
 * Options that several programs have alike: initializers for their tables, which give them an id of their own.
 */
#ifndef CUBEMAP_TOOLS_USUAL_OPTIONS_H
#define CUBEMAP_TOOLS_USUAL_OPTIONS_H

#include "catalogue_name.h"
#include "option_table.h"

#define CM_USUAL_THREADS(number)                                                                   \
    {                                                                                              \
        .id = number, .name = "threads", .kind = CM_OPTION_WHOLE, .argument = "N",                 \
        .help = "threads to use", .more = "The output is the same for any number.",                \
        .standard = "0, one for each core", .low = 0, .high = 1024                                 \
    }

#define CM_USUAL_QUIET(number)                                                                     \
    {                                                                                              \
        .id = number, .name = "quiet",                                                             \
        .help = "neither a progress bar nor a line that says what was done"                        \
    }

#define CM_USUAL_FRAME(number)                                                                     \
    {                                                                                              \
        .id = number, .name = "frame", .kind = CM_OPTION_CHOICE, .argument = "FRAME",              \
        .help = "how the faces of a cube sit on the axes", .standard = "`geo`",                    \
        .choice_at = frame_name_at                                                                 \
    }

#endif
