/* SPDX-License-Identifier: MIT
 *
 * Where a program reads and writes: so that tests and fuzzers call it as a function.
 */
#ifndef TOOLS_CLI_STREAMS_H
#define TOOLS_CLI_STREAMS_H

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cm_streams
{
    FILE *in;
    FILE *out;
    FILE *err;
} cm_streams;

#ifdef __cplusplus
}
#endif

#endif
