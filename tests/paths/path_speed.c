/* SPDX-License-Identifier: MIT
 *
 * Nanoseconds a point of the reference and of the tested path, on the same random points in cache, by
 * turns, the best of many; compared before they are timed.
 */
#define _POSIX_C_SOURCE 200809L

#include "paths.h"

#include <time.h>

enum
{
    COUNT = 8192,
    REPETITIONS = 40
};

typedef struct pair
{
    double scalar, tested; /* ns a point */
} pair;

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double time_call(const cm_mapping *mapping, const path *p, void *const *in, void *const *out)
{
    double begin = seconds();
    (void)p->forms[0].call(mapping, COUNT, in, out, p->forms[0].argument);
    return (seconds() - begin) * 1e9 / COUNT;
}

static pair time_subject(const subject *s, const precision *in, const path *p)
{
    static double memory[2 * COLUMNS_MAX][COUNT];
    void *input[COLUMNS_MAX], *output[COLUMNS_MAX];
    pair best = {INFINITY, INFINITY};
    for (size_t k = 0; k < COLUMNS_MAX; k++)
    {
        input[k] = memory[k];
        output[k] = memory[COLUMNS_MAX + k];
    }
    for (size_t i = 0; i < COUNT; i++)
    {
        number point[COLUMNS_MAX];
        random_input(p->kind, i, 1, point);
        for (size_t k = 0; p->inputs[k] != '\0'; k++)
        {
            put_value(p->inputs[k], in, input[k], i, point[k]);
        }
    }
    compare_points(s, in, p, COUNT, input, &(extreme){0});
    for (int r = 0; r < REPETITIONS; r++)
    {
        best.scalar = fmin(best.scalar, time_call(s->reference, p, input, output));
        best.tested = fmin(best.tested, time_call(s->tested, p, input, output));
    }
    return best;
}

/* One column of a table, and what its geometric mean is made of. */
typedef struct ratios
{
    double logarithms;
    int count;
} ratios;

static void write_ratio(ratios *all, double ratio)
{
    printf(" %8.2f", ratio);
    all->logarithms += log(ratio);
    all->count++;
}

static void write_mean(const ratios *all)
{
    printf(" %8.2f", exp(all->logarithms / (all->count == 0 ? 1 : all->count)));
}

/* The fast tier of double, beside the exact one of the same set: what it is offered for. */
static void time_fast(size_t index, const path_table *table, size_t which, const char *set,
                      double exact, ratios *all)
{
    const path *p = &table->paths[which];
    precision judged;
    subject s;
    if (make_subject(&s, index, CM_TIER_FAST, set) && is_path_of(&s, &table->in, p, &judged))
    {
        double tested = time_subject(&s, &judged, p).tested;
        printf(" %8.2f", tested);
        write_ratio(all, exact / tested);
    }
    else
    {
        printf(" %8s %8s", "-", "-");
    }
    drop_subject(&s);
}

void time_path(const path_table *const tables[2], size_t which, const char *set, choice chosen)
{
    ratios all[3] = {{0.0, 0}, {0.0, 0}, {0.0, 0}};
    printf("\n%-16s %26s %17s %26s\n%-16s", tables[0]->paths[which].name, tables[0]->in.name,
           "fast tier", tables[1]->in.name, "");
    printf(" %8s %8s %8s %8s %8s %8s %8s %8s\n", "scalar", set, "times", set, "times", "scalar",
           set, "times");
    for (size_t i = 0; i < subject_count(); i++)
    {
        subject s;
        if (make_subject(&s, i, CM_TIER_EXACT, set) && chosen(&s))
        {
            pair wide = time_subject(&s, &tables[0]->in, &tables[0]->paths[which]);
            pair narrow = time_subject(&s, &tables[1]->in, &tables[1]->paths[which]);
            printf("%-16s %8.2f %8.2f", s.specification, wide.scalar, wide.tested);
            write_ratio(&all[0], wide.scalar / wide.tested);
            time_fast(i, tables[0], which, set, wide.tested, &all[1]);
            printf(" %8.2f %8.2f", narrow.scalar, narrow.tested);
            write_ratio(&all[2], narrow.scalar / narrow.tested);
            printf("\n");
        }
        drop_subject(&s);
    }
    printf("%-16s %8s %8s", "geometric mean", "", "");
    write_mean(&all[0]);
    printf(" %8s", "");
    write_mean(&all[1]);
    printf(" %8s %8s", "", "");
    write_mean(&all[2]);
    printf("\n");
}
