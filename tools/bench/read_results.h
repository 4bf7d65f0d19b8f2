/* SPDX-License-Identifier: MIT
 *
 * What cubemap-bench --json has written, as far as two runs are compared by it.
 */
#ifndef TOOLS_BENCH_READ_RESULTS_H
#define TOOLS_BENCH_READ_RESULTS_H

#include <stddef.h>
#include <stdio.h>

#include "tools/cli/failure.h"

/* The samples of a way in a direction. */
typedef struct series
{
    const char *word[4]; /* mapping, precision, form, direction */
    double *samples;     /* ns a point */
    size_t count;        /* one or more */
} series;

enum
{
    CONDITIONS = 7
};

/* What times depend on beside the code, as people call it. */
extern const char *const condition_names[CONDITIONS];

typedef struct results
{
    const char *date;
    const char *commit;
    const char *condition[CONDITIONS];
    char points[32]; /* one of them */
    size_t count;
    series *list;   /* as in the file, each once */
    series **named; /* the same, sorted by their words */
    void *document; /* whose the texts are */
} results;

/* Which of two comes first among those that are sorted; 0: they are of the same way and direction. */
int compare_series(const series *a, const series *b);

/* Reads a file of results; the name is for messages. False after a failure. To be freed in any case. */
bool read_results(FILE *in, const char *name, results *r, cm_failure *failure);
void free_results(results *r);

#endif
