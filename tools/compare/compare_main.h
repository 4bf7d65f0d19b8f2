/* SPDX-License-Identifier: MIT
 *
 * cubemap-compare as a function, and its options: how far two images of the same size are from each other.
 */
#ifndef CUBEMAP_TOOLS_COMPARE_MAIN_H
#define CUBEMAP_TOOLS_COMPARE_MAIN_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_compare_command;

/* The exit status. May be called any number of times, but not by two threads at a time. */
int cm_compare_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
