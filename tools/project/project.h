/* SPDX-License-Identifier: MIT
 *
 * cubemap-project as a function, and its options.
 */
#ifndef TOOLS_PROJECT_PROJECT_H
#define TOOLS_PROJECT_PROJECT_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_project_command;

/* Returns the exit status. */
int cm_project_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
