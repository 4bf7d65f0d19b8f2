/* SPDX-License-Identifier: MIT
 *
 * Two runs of cubemap-bench, way by way.
 */
#ifndef TOOLS_BENCH_COMPARE_RESULTS_H
#define TOOLS_BENCH_COMPARE_RESULTS_H

#include "read_results.h"

typedef struct verdict
{
    size_t compared;
    size_t mute;   /* of too few samples for any difference to be significant */
    size_t slower; /* significantly */
    size_t faster;
    size_t past_gate;    /* slower by more than the gate */
    const series *worst; /* the slowest of those; NULL if there is none */
    double worst_change; /* its medians' relative change */
} verdict;

/* Prints the medians of both, their changes and what is to be known of them, and says what came out. gate is a relative
 * change. */
verdict print_comparison(FILE *out, const results *old, const results *new, double alpha,
                         double gate);

#endif
