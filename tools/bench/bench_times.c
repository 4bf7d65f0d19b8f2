/* SPDX-License-Identifier: MIT
 *
 * Times: every repetition takes a sample of every way in each direction, so that what else the machine does falls
 * on all alike. A sample is of as many calls as a thousand of the clock's ticks take; one call before it brings the
 * points into the cache. Every repetition has its arrays elsewhere, so that what that makes is in the samples of one run
 * and not only between runs.
 */
#include "bench.h"

#include "truth/sphere.h"

/* Directions of length 1, the same for all; the arrays as place says. */
static void batch_make(batch *b, size_t count, uint64_t *place)
{
    uint64_t state = 7;
    batch_scatter(b, count, place);
    b->count = count;
    for (size_t i = 0; i < count; i++)
    {
        double d[3];
        next_direction(&state, d);
        double size = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        batch_put(b, i, (const double[]){d[0] / size, d[1] / size, d[2] / size});
    }
}

static void run(const way *w, batch *b, int direction)
{
    (w->form == FORM_ARRAY ? run_arrays : run_points)(w->mapping, w->precision == PRECISION_FLOAT,
                                                      b, direction);
}

static double seconds_of(const way *w, batch *b, int direction, size_t calls)
{
    const double start = seconds();
    for (size_t i = 0; i < calls; i++)
    {
        run(w, b, direction);
    }
    return seconds() - start;
}

typedef struct timed_way
{
    const way *way;
    batch *batch;
    int direction;
} timed_way;

static double time_way(void *user, size_t calls)
{
    const timed_way *t = user;
    return seconds_of(t->way, t->batch, t->direction, calls);
}

static size_t calls_of(const way *w, batch *b, int direction)
{
    timed_way timed = {w, b, direction};
    return calls_a_sample(time_way, &timed);
}

/* ns a point */
static double take_sample(const way *w, batch *b, int direction, size_t calls)
{
    return seconds_of(w, b, direction, calls) * 1e9 / ((double)calls * (double)b->count);
}

void measure_times(suite *all, stage part)
{
    uint64_t place = 1;
    for (size_t r = 0; r < all->set.repetitions; r++)
    {
        batch b;
        batch_make(&b, all->set.points, &place);
        for (size_t i = 0; i < all->way_count; i++)
        {
            way *w = &all->ways[i];
            for (int direction = 0; direction < DIRECTIONS; direction++)
            {
                if (r == 0)
                {
                    w->samples[direction] = allocate(all->set.repetitions, sizeof(double));
                    w->calls[direction] = calls_of(w, &b, direction);
                }
                run(w, &b, direction);
                w->samples[direction][r] = take_sample(w, &b, direction, w->calls[direction]);
            }
        }
        batch_free(&b);
        stage_progress(part, r + 1, all->set.repetitions, "times");
    }
    for (size_t i = 0; i < all->way_count; i++)
    {
        for (int direction = 0; direction < DIRECTIONS; direction++)
        {
            all->ways[i].time[direction] =
                summary(all->ways[i].samples[direction], all->set.repetitions);
        }
    }
}

/* ---- Cost against the length of the array ---- */

/* 1, 2, 4, ... 64, then 100, 300, 1000, ... */
static size_t next_length(size_t n)
{
    if (n < 64)
    {
        return 2 * n;
    }
    size_t decade = 100;
    while (10 * decade <= n)
    {
        decade *= 10;
    }
    return n < 100 ? 100 : n < 3 * decade ? 3 * decade : 10 * decade;
}

/* The best of some runs over arrays of n. */
static double time_length(const way *w, batch *b, size_t n, int direction)
{
    size_t repetitions = n > 1000000 ? 3 : 20;
    double best = (double)INFINITY;
    b->count = n;
    const size_t calls = calls_of(w, b, direction);
    for (size_t r = 0; r < repetitions; r++)
    {
        best = fmin(best, take_sample(w, b, direction, calls));
    }
    return best;
}

static void add_lengths(suite *all, const way *w, batch *b)
{
    subject *s = &all->subjects[w->subject];
    for (size_t n = 1; n <= all->set.largest; n = next_length(n))
    {
        s->lengths = grow(s->lengths, s->length_count, sizeof *s->lengths);
        length_row *l = &s->lengths[s->length_count++];
        *l = (length_row){.points = n, .precision = w->precision};
        for (int direction = 0; direction < DIRECTIONS; direction++)
        {
            l->ns[direction] = time_length(w, b, n, direction);
        }
    }
}

void measure_lengths(suite *all, stage part)
{
    batch b;
    uint64_t place = 1;
    if (all->set.largest == 0)
    {
        return;
    }
    batch_make(&b, all->set.largest, &place);
    for (size_t i = 0; i < all->way_count; i++)
    {
        const way *w = &all->ways[i];
        if (w->form == FORM_ARRAY && w->precision != PRECISION_FAST)
        {
            add_lengths(all, w, &b);
        }
        stage_progress(part, i + 1, all->way_count, "cost against length");
    }
    batch_free(&b);
}
