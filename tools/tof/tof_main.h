/* SPDX-License-Identifier: MIT
 *
 * cubemap-tof as a function, and its options: time-of-flight cameras, simulated to the electron.
 */
#ifndef CUBEMAP_TOOLS_TOF_MAIN_H
#define CUBEMAP_TOOLS_TOF_MAIN_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_tof_command;

/* The exit status. May be called any number of times, but not by two threads at a time. */
int cm_tof_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
