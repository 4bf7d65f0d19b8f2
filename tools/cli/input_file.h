/* SPDX-License-Identifier: MIT
 *
 * The files that filters read. A harness has its own function in place of this one.
 */
#ifndef TOOLS_CLI_INPUT_FILE_H
#define TOOLS_CLI_INPUT_FILE_H

#include "failure.h"

/* The file of that name, to be closed with fclose; NULL after a failure. */
FILE *open_input(const char *name, cm_failure *failure);

#endif
