/* SPDX-License-Identifier: MIT
 *
 * cubemap-latitude as a function, and its options.
 */
#ifndef TOOLS_LATITUDE_CUBEMAP_LATITUDE_H
#define TOOLS_LATITUDE_CUBEMAP_LATITUDE_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_latitude_command;

/* Returns the exit status. */
int cm_latitude_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
