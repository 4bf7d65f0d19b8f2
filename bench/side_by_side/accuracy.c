/* SPDX-License-Identifier: MIT
 *
 * Worst errors of round trips, direction to plane and back, in metres on Earth: the angle between
 * what a contestant was given and what it gives back, as tests/peers and truth/certificate have
 * it. A point that it refuses, or answers with NaN, counts as refused.
 */
#include "side_by_side.h"

#include "truth/peers/peers.h"
#include "truth/sphere.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum
{
    BLOCK = 4096
};

/* What point i of a batch was, and what came back, as directions. 0 if nothing came back. */
static int directions_of(const contestant *c, const peer_subject *subject, const batch *b, size_t i,
                         double truth[3], double found[3])
{
    double back[3] = {0.0, 0.0, 0.0};
    int count = c->unit == 0.0 ? 3 : 2;
    if (b->status[FORWARD][i] != 0 || b->status[INVERSE][i] != 0)
    {
        return 0;
    }
    for (int k = 0; k < count; k++)
    {
        back[k] = c->narrow ? (double)b->back_f32[k][i] : b->back[k][i];
        if (!isfinite(back[k]))
        {
            return 0;
        }
    }
    const double from[3] = {b->from[0][i], b->from[1][i], b->from[2][i]};
    peer_direction(subject, from, truth);
    peer_direction(subject, back, found);
    for (int k = 0; k < 3 && c->narrow; k++)
    {
        truth[k] = (double)b->from_f32[k][i];
    }
    return 1;
}

static double worst_of_block(contestant *c, batch *b)
{
    peer_subject subject;
    memset(&subject, 0, sizeof subject);
    subject.unit = c->unit;
    for (int direction = 0; direction < DIRECTIONS; direction++)
    {
        contestant_ready(c, b, direction);
        contestant_run(c, b, direction);
    }
    double worst = 0.0;
    for (size_t i = 0; i < b->count; i++)
    {
        double truth[3];
        double found[3];
        c->tried++;
        if (directions_of(c, &subject, b, i, truth, found))
        {
            worst = fmax(worst, earth_metres(truth, found));
        }
        else
        {
            c->refused++;
        }
    }
    return worst;
}

static double worst_of(contestant *c, const double *points, size_t count)
{
    batch b;
    double worst = 0.0;
    batch_allocate(&b, BLOCK);
    for (size_t at = 0; at < count; at += BLOCK)
    {
        batch_load(&b, c, points + 3 * at, count - at < BLOCK ? count - at : BLOCK);
        worst = fmax(worst, worst_of_block(c, &b));
    }
    batch_free(&b);
    return worst;
}

/* Points for contestants of one kind; the hard ones are not the same for all. */
typedef struct point_lists
{
    const contestant *of;
    size_t hard_count;
    double *random;
    double *hard;
} point_lists;

static int takes_the_same(const contestant *a, const contestant *b)
{
    return a->unit == b->unit && a->own == b->own && a->narrow == b->narrow &&
           strcmp(a->tier, b->tier) == 0;
}

static const point_lists *lists_of(point_lists *lists, const contestant *c, size_t random_count,
                                   size_t hard_step)
{
    while (lists->of != NULL && !takes_the_same(lists->of, c))
    {
        lists++;
    }
    if (lists->of == NULL)
    {
        lists->of = c;
        lists->random = random_points(c, random_count);
        lists->hard = hard_points(c, hard_step, &lists->hard_count);
    }
    return lists;
}

void measure_accuracy(roster *all, size_t random_count, size_t hard_step)
{
    point_lists lists[16];
    memset(lists, 0, sizeof lists);
    for (size_t i = 0; i < all->count; i++)
    {
        contestant *c = &all->list[i];
        const point_lists *points = lists_of(lists, c, random_count, hard_step);
        progress("errors: %zu of %zu, %s %s", i + 1, all->count, c->library, c->specification);
        c->worst_random = worst_of(c, points->random, random_count);
        c->worst_hard = worst_of(c, points->hard, points->hard_count);
    }
    for (const point_lists *each = lists; each->of != NULL; each++)
    {
        free(each->random);
        free(each->hard);
    }
    progress(NULL);
}
