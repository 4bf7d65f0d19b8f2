/* SPDX-License-Identifier: MIT
 *
 * Times. Every repetition runs every contestant once, so that what else the machine does falls on
 * all alike; each is run once before it is timed, so that its points are in the cache, and itself
 * in the machine's predictors.
 */
#include "side_by_side.h"

#include <stdlib.h>
#include <string.h>

#ifdef HAVE_CALLGRIND
#include <valgrind/callgrind.h>
#endif

/* Who took longer than this the last time is warm enough. */
static const double long_run = 2e-3;

void contestant_ready(const contestant *c, batch *b, int direction)
{
    for (int k = 0; k < 2 && c->in_place; k++)
    {
        double *to = direction == FORWARD ? b->plane[k] : b->back[k];
        const double *from = direction == FORWARD ? b->from[k] : b->plane[k];
        memcpy(to, from, b->count * sizeof to[0]);
    }
}

void contestant_run(const contestant *c, batch *b, int direction)
{
    (direction == FORWARD ? c->forward : c->inverse)(c, b);
}

/* ns a point */
static double time_once(const contestant *c, batch *b, int direction)
{
    contestant_ready(c, b, direction);
    double start = seconds();
    contestant_run(c, b, direction);
    return (seconds() - start) * 1e9 / (double)b->count;
}

/* This library's fastest exact double path for a group: what ratios are of. */
static const contestant *reference(const roster *all, const char *group, int direction)
{
    const contestant *best = NULL;
    for (size_t i = 0; i < all->count; i++)
    {
        const contestant *c = &all->list[i];
        int of_group = strcmp(c->group, group) == 0 && strcmp(c->specification, group) == 0;
        if (of_group && c->array && !c->narrow && strcmp(c->tier, "exact") == 0 &&
            (best == NULL || c->time[direction].median < best->time[direction].median))
        {
            best = c;
        }
    }
    return best;
}

/* The median of the ratios of each repetition: what slows the machine down for longer than the few
 * milliseconds between the two is in both. */
static double ratio_to(const contestant *c, const contestant *of, int direction, size_t count)
{
    double *ratios = allocate(count, sizeof ratios[0]);
    for (size_t r = 0; r < count; r++)
    {
        ratios[r] = c->samples[direction][r] / of->samples[direction][r];
    }
    double median = summary(ratios, count).median;
    free(ratios);
    return median;
}

static void summarise(roster *all, int direction, size_t repetitions)
{
    for (size_t i = 0; i < all->count; i++)
    {
        contestant *c = &all->list[i];
        c->time[direction] = summary(c->samples[direction], repetitions);
    }
    for (size_t i = 0; i < all->count; i++)
    {
        contestant *c = &all->list[i];
        const contestant *best = reference(all, c->group, direction);
        c->ratio[direction] = ratio_to(c, best, direction, repetitions);
    }
}

/* Points of several repetitions: processors remember the branches of thousands of points that come again and again, which a
 * program's points do not. */
enum
{
    DISTINCT = 1 << 17,
    WINDOWS = 16
};

/* Contestants that take the same form of points share batches, each of which has other points. */
typedef struct shared_batches
{
    size_t count;
    size_t points;
    size_t windows;
    const contestant *of[8];
    batch batches[8][WINDOWS];
} shared_batches;

static shared_batches *share_batches(size_t points, size_t most_windows)
{
    shared_batches *all = allocate(1, sizeof *all);
    const size_t windows = DISTINCT / points;
    all->count = 0;
    all->points = points;
    all->windows = windows < 1 ? 1 : windows < most_windows ? windows : most_windows;
    return all;
}

static void load_windows(const shared_batches *all, const contestant *c, batch *batches)
{
    double *list = random_points(c, all->points * all->windows);
    for (size_t window = 0; window < all->windows; window++)
    {
        batch_allocate(&batches[window], all->points);
        batch_load(&batches[window], c, list + 3 * all->points * window, all->points);
    }
    free(list);
}

static batch *batch_of(shared_batches *all, const contestant *c, size_t repetition)
{
    size_t i = 0;
    while (i < all->count && (all->of[i]->unit != c->unit || all->of[i]->by_face != c->by_face))
    {
        i++;
    }
    if (i == all->count)
    {
        all->of[i] = c;
        load_windows(all, c, all->batches[i]);
        all->count++;
    }
    return &all->batches[i][repetition % all->windows];
}

static void free_batches(shared_batches *all)
{
    for (size_t i = 0; i < all->count; i++)
    {
        for (size_t window = 0; window < all->windows; window++)
        {
            batch_free(&all->batches[i][window]);
        }
    }
    free(all);
}

void time_all(roster *all, size_t points, size_t repetitions)
{
    shared_batches *shared = share_batches(points, WINDOWS);
    for (size_t r = 0; r < repetitions; r++)
    {
        for (size_t i = 0; i < all->count; i++)
        {
            contestant *c = &all->list[i];
            batch *b = batch_of(shared, c, r);
            progress("times: repetition %zu of %zu, %s %s", r + 1, repetitions, c->library,
                     c->specification);
            for (int direction = 0; direction < DIRECTIONS; direction++)
            {
                if (r == 0)
                {
                    c->samples[direction] = allocate(repetitions, sizeof(double));
                }
                double *samples = c->samples[direction];
                if (r == 0 || samples[r - 1] * 1e-9 * (double)points < long_run)
                {
                    (void)time_once(c, b, direction);
                }
                samples[r] = time_once(c, b, direction);
            }
        }
    }
    summarise(all, FORWARD, repetitions);
    summarise(all, INVERSE, repetitions);
    progress(NULL);
    free_batches(shared);
}

#ifdef HAVE_CALLGRIND
int count_all(roster *all, size_t points)
{
    shared_batches *shared = share_batches(points, 1);
    CALLGRIND_START_INSTRUMENTATION;
    for (size_t i = 0; i < all->count; i++)
    {
        const contestant *c = &all->list[i];
        batch *b = batch_of(shared, c, 0);
        for (int direction = 0; direction < DIRECTIONS; direction++)
        {
            char label[128];
            char text[256];
            contestant_label(c, label, sizeof label);
            snprintf(text, sizeof text, "%s|%s|%s", c->group, label,
                     direction == FORWARD ? "forward" : "inverse");
            contestant_ready(c, b, direction);
            contestant_run(c, b, direction); /* once for what is only done the first time */
            contestant_ready(c, b, direction);
            CALLGRIND_ZERO_STATS;
            contestant_run(c, b, direction);
            CALLGRIND_DUMP_STATS_AT(text);
        }
    }
    free_batches(shared);
    return 1;
}
#else
int count_all(roster *all, size_t points)
{
    (void)all;
    (void)points;
    return 0;
}
#endif
