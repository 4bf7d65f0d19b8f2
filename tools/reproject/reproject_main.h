/* SPDX-License-Identifier: MIT
 *
 * cubemap-reproject as a function, and its options: an image of the sphere from one projection to another.
 */
#ifndef CUBEMAP_TOOLS_REPROJECT_MAIN_H
#define CUBEMAP_TOOLS_REPROJECT_MAIN_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_reproject_command;

/* The exit status. May be called any number of times, but not by two threads at a time. */
int cm_reproject_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
