/* SPDX-License-Identifier: MIT
 *
 * cubemap-octree as a function, and its options: maps of scenes from depth views, asked, drawn and merged.
 */
#ifndef CUBEMAP_TOOLS_OCTREE_MAIN_H
#define CUBEMAP_TOOLS_OCTREE_MAIN_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_octree_command;

/* The exit status. May be called any number of times, but not by two threads at a time. */
int cm_octree_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
