/* SPDX-License-Identifier: MIT
 *
 * cubemap-scene as a function, and its options: what depth cameras see, rendered, told, converted and judged.
 */
#ifndef CUBEMAP_TOOLS_SCENE_MAIN_H
#define CUBEMAP_TOOLS_SCENE_MAIN_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_scene_command;

/* The exit status. May be called any number of times, but not by two threads at a time. */
int cm_scene_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
