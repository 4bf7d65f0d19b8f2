/* SPDX-License-Identifier: MIT
 *
 * The clock, and what is taken of many samples.
 */
#define _POSIX_C_SOURCE 200809L

#include "harness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double processor_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

void date_now(char text[DATE_SIZE])
{
    const time_t now = time(NULL);
    struct tm parts;
    if (gmtime_r(&now, &parts) == NULL ||
        strftime(text, DATE_SIZE, "%Y-%m-%dT%H:%M:%SZ", &parts) == 0)
    {
        memcpy(text, "unknown", sizeof "unknown");
    }
}

/* A thousandth of a sample is within a tick. */
static const double ticks_a_sample = 1000.0;

enum
{
    TICKS = 101
};

double clock_tick(void)
{
    static double tick;
    double steps[TICKS];
    for (size_t i = 0; i < TICKS && tick == 0.0; i++)
    {
        const double start = seconds();
        double now = start;
        while (now <= start)
        {
            now = seconds();
        }
        steps[i] = now - start;
    }
    tick = tick == 0.0 ? summary(steps, TICKS).median : tick;
    return tick;
}

size_t calls_for_sample(size_t calls, double took)
{
    const double wanted = ticks_a_sample * clock_tick();
    if (took >= wanted)
    {
        return calls;
    }
    /* somewhat more, for the next time may be shorter; not all at once, for the first times are uncertain */
    const double more = 1.1 * (double)calls * fmin(wanted / took, 100.0);
    return (size_t)fmax(more, (double)calls + 1.0);
}

size_t calls_a_sample(calls_timer timer, void *user)
{
    size_t calls = 0;
    for (size_t next = 1; next != calls;)
    {
        calls = next;
        double least = timer(user, calls);
        for (int again = 0; again < 2; again++)
        {
            least = fmin(least, timer(user, calls));
        }
        next = calls_for_sample(calls, least);
    }
    return calls;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

double *sorted_copy(const double *samples, size_t count)
{
    double *sorted = allocate(count, sizeof sorted[0]);
    memcpy(sorted, samples, count * sizeof sorted[0]);
    qsort(sorted, count, sizeof sorted[0], compare);
    return sorted;
}

double sorted_median(const double *sorted, size_t count)
{
    return count % 2 == 1 ? sorted[count / 2]
                          : 0.5 * sorted[count / 2 - 1] + 0.5 * sorted[count / 2];
}

timing summary(const double *samples, size_t count)
{
    double *sorted = sorted_copy(samples, count);
    timing t = {sorted[0], sorted[count / 4], sorted_median(sorted, count), sorted[3 * count / 4]};
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
        fprintf(harness_err(), "%s: no memory\n", program_name());
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
        fprintf(harness_err(), "%s: no memory\n", program_name());
        harness_end();
    }
    return more;
}
