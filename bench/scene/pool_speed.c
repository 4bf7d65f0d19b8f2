/* SPDX-License-Identifier: MIT
 *
 * What threads that stay cost, beside threads that are made: the median of calls back to back whose pieces do nothing, as many
 * as there are threads, and of calls whose threads must all come, since each waits for the others; and random numbers, a
 * number, beside the machine's memcpy of as many.
 *
 *   pool-speed [THREADS]     2, or as many as there are processors
 */
#define _POSIX_C_SOURCE 200809L

#include "bench/harness/harness.h"

#include <cubemap/pool.h>
#include <cubemap/random.h>

#include <sched.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
    CALLS = 20001,
    NUMBERS = 640 * 480,
    RUNS = 11
};

static atomic_uint here;
static unsigned processors;

static void do_nothing(size_t begin, size_t end, void *user)
{
    (void)begin;
    (void)end;
    (void)user;
}

static void meet(size_t begin, size_t end, void *user)
{
    atomic_fetch_add(&here, (unsigned)(end - begin));
    /* to yield would be to wait for other programs; only where there are more threads than processors it is needed */
    const unsigned all = *(const unsigned *)user;
    while (atomic_load(&here) < all)
    {
        if (all > processors)
        {
            sched_yield();
        }
    }
}

static double median_of(cm_pool *pool, unsigned threads, cm_job job, size_t calls)
{
    double *took = allocate(calls, sizeof *took);
    for (size_t i = 0; i < calls; i++)
    {
        atomic_store(&here, 0);
        const double start = seconds();
        if (pool != NULL)
        {
            cm_pool_run(pool, threads, 1, job, &threads);
        }
        else
        {
            cm_run_threads(threads, (size_t)64 * threads, 64, job, &threads);
        }
        took[i] = seconds() - start;
    }
    double *sorted = sorted_copy(took, calls);
    const double median = sorted_median(sorted, calls);
    free(sorted);
    free(took);
    return 1e6 * median;
}

static double value[NUMBERS], mean[NUMBERS];

static void print_numbers(const char *what, int kind, double of)
{
    double took[RUNS];
    for (size_t i = 0; i < NUMBERS; i++)
    {
        mean[i] = of;
    }
    for (uint32_t i = 0; i < RUNS; i++)
    {
        const double start = seconds();
        switch (kind)
        {
        case 0:
            memcpy(value, mean, sizeof value);
            break;
        case 1:
            cm_random_uniform_array(1, i, 0, 0, NUMBERS, value);
            break;
        case 2:
            cm_random_normal_array(1, i, 0, 0, NUMBERS, value);
            break;
        default:
            cm_random_poisson_array(1, i, 0, 0, NUMBERS, mean, value);
        }
        took[i] = (seconds() - start) * 1e9 / NUMBERS;
    }
    const timing t = summary(took, RUNS);
    printf("%-34s %8.2f ns a number, best %8.2f\n", what, t.median, t.best);
}

int main(int count, char **arguments)
{
    name_program("pool-speed");
    const unsigned threads = count > 1 ? (unsigned)atoi(arguments[1]) : cm_threads_available();
    cm_pool *pool;
    processors = cm_threads_available();
    if (threads < 1 || cm_pool_create(threads, &pool) != CM_OK)
    {
        fprintf(stderr, "pool-speed: THREADS is no number of threads\n");
        return 2;
    }
    printf("%u threads on %u processors\n", threads, processors);
    printf("%-34s %8.2f us a call, target 10\n", "pool, empty pieces",
           median_of(pool, threads, do_nothing, CALLS));
    printf("%-34s %8.2f us a call, target 10\n", "pool, all threads come",
           median_of(pool, threads, meet, CALLS));
    printf("%-34s %8.2f us a call\n", "threads made for the call",
           median_of(NULL, threads, do_nothing, CALLS / 20));
    cm_pool_destroy(pool);
    print_numbers("memcpy", 0, 1.0);
    print_numbers("uniform", 1, 0.0);
    print_numbers("normal", 2, 0.0);
    print_numbers("Poisson, mean 3", 3, 3.0);
    print_numbers("Poisson, mean 1000", 3, 1000.0);
    return close_standard_output();
}
