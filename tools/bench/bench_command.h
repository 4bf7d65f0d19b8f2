/* SPDX-License-Identifier: MIT
 *
 * cubemap-bench as a function, and its options.
 */
#ifndef TOOLS_BENCH_BENCH_COMMAND_H
#define TOOLS_BENCH_BENCH_COMMAND_H

#include "tools/cli/option_table.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const cm_command cm_bench_command;

/* Returns the exit status. */
int cm_bench_main(int argc, char **argv, const cm_streams *streams);

#ifdef __cplusplus
}
#endif

#endif
