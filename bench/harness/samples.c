/* SPDX-License-Identifier: MIT
 *
 * The clock, and what is taken of many samples.
 */
#define _POSIX_C_SOURCE 200809L

#include "harness.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

timing summary(const double *samples, size_t count)
{
    double *sorted = allocate(count, sizeof sorted[0]);
    memcpy(sorted, samples, count * sizeof sorted[0]);
    qsort(sorted, count, sizeof sorted[0], compare);
    timing t = {sorted[0], sorted[count / 4], sorted[count / 2], sorted[3 * count / 4]};
    free(sorted);
    return t;
}

double spread(const timing *t)
{
    return 50.0 * (t->upper_quartile - t->lower_quartile) / t->median;
}

void *allocate(size_t count, size_t size)
{
    void *memory = calloc(count == 0 ? 1 : count, size);
    if (memory == NULL)
    {
        fprintf(harness_err(), "%s: no memory\n", program_name);
        harness_end();
    }
    return memory;
}

/* Memory is for a power of two of elements: more is needed when there are as many. */
void *grow(void *list, size_t count, size_t size)
{
    if ((count & (count - 1)) != 0)
    {
        return list;
    }
    void *more = realloc(list, (count == 0 ? 1 : 2 * count) * size);
    if (more == NULL)
    {
        fprintf(harness_err(), "%s: no memory\n", program_name);
        harness_end();
    }
    return more;
}
