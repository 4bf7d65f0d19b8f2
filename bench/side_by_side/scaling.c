/* SPDX-License-Identifier: MIT
 *
 * Cost against the length of the array: from one point, where the call itself counts, to more than
 * any cache holds. The arrays of the longest are allocated once; inverse overwrites what forward
 * has read, with the same points but for rounding.
 *
 * Lengths of up to TOGETHER points are timed in turn, again and again, as contestants are: one after the
 * other, a minute in which the machine is slower would be a step at some length, alike in all contestants.
 */
#include "side_by_side.h"

#include "truth/sphere.h"

#include <stdlib.h>
#include <string.h>

enum
{
    EACH_UP_TO = 64,
    AT_ONCE = 4096,  /* points that are timed together where the array is shorter */
    TOGETHER = 10000 /* the longest of the lengths that are timed in turn */
};

static const char *const mappings[] = {"gnomonic", "coupled", "tangent"};

static int is_measured(const contestant *c, int narrow)
{
    for (size_t i = 0; i < sizeof mappings / sizeof mappings[0]; i++)
    {
        if (strcmp(c->specification, mappings[i]) == 0)
        {
            return c->own && c->array && c->narrow == narrow && strcmp(c->tier, "exact") == 0;
        }
    }
    return 0;
}

/* 1, 2, ... 64, 100, 200, 500, 1000, ... */
static size_t next_length(size_t n)
{
    if (n < EACH_UP_TO)
    {
        return n + 1;
    }
    size_t decade = 100;
    while (10 * decade <= n)
    {
        decade *= 10;
    }
    return n < 100 ? 100 : n < 2 * decade ? 2 * decade : n < 5 * decade ? 5 * decade : 10 * decade;
}

/* bytes a point: five numbers and a face */
static double bytes_of(size_t n, int narrow)
{
    return (double)n * (5.0 * (narrow ? sizeof(float) : sizeof(double)) + 1.0);
}

static size_t longest_that_fits(size_t largest, int narrow)
{
    double memory = system_free_memory();
    size_t longest = 1;
    for (size_t n = 1; n <= largest; n = next_length(n))
    {
        longest = memory == 0.0 || bytes_of(n, narrow) < 0.9 * memory ? n : longest;
    }
    if (next_length(longest) <= largest)
    {
        fprintf(stderr,
                "side-by-side: arrays of %zu points at most, for there are %.1f GB of memory\n",
                longest, memory * 1e-9);
    }
    return longest;
}

static void allocate_arrays(batch *b, size_t room, int narrow)
{
    uint64_t state = 5;
    memset(b, 0, sizeof *b);
    for (int k = 0; k < 3; k++)
    {
        b->from[k] = b->back[k] = narrow ? NULL : allocate(room, sizeof(double));
        b->from_f32[k] = b->back_f32[k] = narrow ? allocate(room, sizeof(float)) : NULL;
    }
    for (int k = 0; k < 2; k++)
    {
        b->plane[k] = narrow ? NULL : allocate(room, sizeof(double));
        b->plane_f32[k] = narrow ? allocate(room, sizeof(float)) : NULL;
    }
    b->face = allocate(room, 1);
    for (size_t i = 0; i < room; i++)
    {
        double direction[3];
        next_direction(&state, direction);
        for (int k = 0; k < 3; k++)
        {
            if (narrow)
            {
                b->from_f32[k][i] = (float)direction[k];
            }
            else
            {
                b->from[k][i] = direction[k];
            }
        }
    }
}

static void free_arrays(batch *b)
{
    for (int k = 0; k < 3; k++)
    {
        free(b->from[k]);
        free(b->from_f32[k]);
    }
    for (int k = 0; k < 2; k++)
    {
        free(b->plane[k]);
        free(b->plane_f32[k]);
    }
    free(b->face);
}

static void add_row(scaling *all, const contestant *c, size_t n)
{
    all->rows = grow(all->rows, all->count, sizeof *all->rows);
    scaling_row row = {c, n, {1e300, 1e300}};
    all->rows[all->count++] = row;
}

static void time_row(scaling_row *row, batch *b)
{
    size_t calls = row->points < AT_ONCE ? AT_ONCE / row->points : 1;
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        double start = seconds();
        for (size_t i = 0; i < calls; i++)
        {
            contestant_run(row->who, b, direction);
        }
        double each = (seconds() - start) * 1e9 / (double)(calls * row->points);
        row->best[direction] = each < row->best[direction] ? each : row->best[direction];
    }
}

/* Rows of all contestants at one length. */
static void add_length(const roster *all, int narrow, size_t n, scaling *result)
{
    for (size_t i = 0; i < all->count; i++)
    {
        if (is_measured(&all->list[i], narrow))
        {
            add_row(result, &all->list[i], n);
        }
    }
}

/* The rows from the first on, interleaved. */
static void time_rows(size_t first, batch *b, size_t repetitions, scaling *result)
{
    for (size_t r = 0; r < repetitions; r++)
    {
        for (size_t i = first; i < result->count; i++)
        {
            b->count = result->rows[i].points;
            time_row(&result->rows[i], b);
        }
    }
}

/* Long arrays take seconds, and vary less. */
static size_t repetitions_of(size_t n, size_t repetitions)
{
    size_t limit = n > 10000000 ? 2 : n > 100000 ? 5 : repetitions;
    return repetitions < limit ? repetitions : limit;
}

void measure_scaling(const roster *all, size_t largest, size_t repetitions, scaling *result)
{
    memset(result, 0, sizeof *result);
    for (int narrow = 0; narrow < 2; narrow++)
    {
        batch b;
        size_t longest = longest_that_fits(largest, narrow);
        progress("scaling: making %zu points", longest);
        allocate_arrays(&b, longest, narrow);
        size_t n = 1;
        size_t first = result->count;
        for (; n <= longest && n <= TOGETHER; n = next_length(n))
        {
            add_length(all, narrow, n, result);
        }
        progress("scaling: %s, short arrays", narrow ? "float" : "double");
        time_rows(first, &b, repetitions, result);
        for (; n <= longest; n = next_length(n))
        {
            progress("scaling: %s, arrays of %zu points", narrow ? "float" : "double", n);
            first = result->count;
            add_length(all, narrow, n, result);
            time_rows(first, &b, repetitions_of(n, repetitions), result);
        }
        free_arrays(&b);
    }
    progress(NULL);
}
