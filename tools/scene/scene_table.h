/* SPDX-License-Identifier: MIT
 *
 * What the options of cubemap-scene are called in its source, and its commands.
 */
#ifndef CUBEMAP_TOOLS_SCENE_TABLE_H
#define CUBEMAP_TOOLS_SCENE_TABLE_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

enum
{
    SCENE_OUTPUT = 1,
    SCENE_NOISE,
    SCENE_SEED,
    SCENE_TRUTH,
    SCENE_CAMERA,
    SCENE_TO,
    SCENE_THREADS,
    SCENE_JSON,
    SCENE_QUIET
};

extern const cm_command scene_render_command;
extern const cm_command scene_info_command;
extern const cm_command scene_convert_command;
extern const cm_command scene_evaluate_command;

#ifdef __cplusplus
}
#endif

#endif
