/* SPDX-License-Identifier: MIT
 *
 * cubemap-orient as a function, and its options: the best orientation of the base cube for a mask.
 */
#ifndef CUBEMAP_TOOLS_ORIENT_MAIN_H
#define CUBEMAP_TOOLS_ORIENT_MAIN_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_orient_command;

/* The exit status. May be called any number of times, but not by two threads at a time. */
int cm_orient_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
