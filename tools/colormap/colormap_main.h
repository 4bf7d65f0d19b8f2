/* SPDX-License-Identifier: MIT
 *
 * cubemap-colormap as a function, and its options: perceptually uniform colour maps as tables, as code and as pictures.
 */
#ifndef CUBEMAP_TOOLS_COLORMAP_MAIN_H
#define CUBEMAP_TOOLS_COLORMAP_MAIN_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_colormap_command;

/* The exit status. May be called any number of times, but not by two threads at a time. */
int cm_colormap_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
