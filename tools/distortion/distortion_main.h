/* SPDX-License-Identifier: MIT
 *
 * cubemap-distortion as a function, and its options: pictures of what a mapping does to areas, shapes and angles.
 */
#ifndef CUBEMAP_TOOLS_DISTORTION_MAIN_H
#define CUBEMAP_TOOLS_DISTORTION_MAIN_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_distortion_command;

/* The exit status. May be called any number of times, but not by two threads at a time. */
int cm_distortion_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
