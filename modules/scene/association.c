/* SPDX-License-Identifier: MIT
 *
 * Pairs of stamps, the closest first. The closest two that are left are always neighbours among all that are left, since
 * whatever is between them is closer to one of them: so a list of all, a heap of its neighbours, and one new pair of
 * neighbours for each that is taken.
 *
 * What is as close as the closest pair within rounding is taken with it, in the order of stamps: all pairs whose least
 * distance is not beyond the least of most distances. So any two of these may be as close as they were written. They have a
 * heap of their own, and the next pairs come when it is empty: "as close within rounding" is no order that one heap could
 * have, as of three the first and the last need not be.
 */
#include <cubemap/trajectory.h>

#include <math.h>
#include <stdlib.h>

#include "trajectory_data.h"

#define NONE ((size_t)-1)

/* A stamp of either, in the order of time. */
typedef struct member
{
    double stamp;
    size_t index; /* in its trajectory */
    int is_b;
    int is_taken;
    size_t before; /* of those left; NONE at the ends */
    size_t after;
} member;

/* Neighbours, one of each trajectory. */
typedef struct neighbours
{
    cm_stamps_distance apart;
    size_t first;
    size_t second;
} neighbours;

typedef struct match match;

/* What is sooner than all others is at the top. */
typedef struct heap
{
    int (*is_sooner)(const match *, const neighbours *, const neighbours *);
    neighbours *pair;
    size_t count;
} heap;

struct match
{
    member *all;
    size_t count;
    heap far;    /* the closest first */
    heap close;  /* as close as the closest, the earliest first */
    double most; /* of the closest that came into the heap of these */
    double apart;
    size_t *partner; /* of a's stamps: the index in b, or NONE */
};

static size_t index_of(const match *m, const neighbours *pair, int is_b)
{
    return m->all[pair->first].is_b == is_b ? m->all[pair->first].index
                                            : m->all[pair->second].index;
}

static int is_closer(const match *m, const neighbours *x, const neighbours *y)
{
    (void)m;
    return x->apart.least < y->apart.least;
}

static int is_earlier(const match *m, const neighbours *x, const neighbours *y)
{
    const size_t of_x = index_of(m, x, 0);
    const size_t of_y = index_of(m, y, 0);
    return of_x != of_y ? of_x < of_y : index_of(m, x, 1) < index_of(m, y, 1);
}

static void push(const match *m, heap *to, neighbours pair)
{
    size_t at = to->count++;
    while (at > 0 && to->is_sooner(m, &pair, &to->pair[(at - 1) / 2]))
    {
        to->pair[at] = to->pair[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    to->pair[at] = pair;
}

static neighbours pop(const match *m, heap *from)
{
    const neighbours top = from->pair[0];
    const neighbours last = from->pair[--from->count];
    size_t at = 0;
    for (;;)
    {
        size_t child = 2 * at + 1;
        if (child + 1 < from->count &&
            from->is_sooner(m, &from->pair[child + 1], &from->pair[child]))
        {
            child++;
        }
        if (child >= from->count || !from->is_sooner(m, &from->pair[child], &last))
        {
            break;
        }
        from->pair[at] = from->pair[child];
        at = child;
    }
    from->pair[at] = last;
    return top;
}

static void offer(match *m, size_t first, size_t second)
{
    if (first == NONE || second == NONE || m->all[first].is_b == m->all[second].is_b)
    {
        return;
    }
    const double begin = m->all[first].stamp;
    const double end = m->all[second].stamp;
    if (cm_stamps_within(begin, end, m->apart))
    {
        const neighbours pair = {cm_stamps_apart(begin, end), first, second};
        push(m, pair.apart.least <= m->most ? &m->close : &m->far, pair);
    }
}

static int is_over(const match *m, const neighbours *pair)
{
    return m->all[pair->first].is_taken || m->all[pair->second].is_taken;
}

/* Gathers all that may be the closest pair, when those before are taken; 0 if there are no more. */
static int has_close(match *m)
{
    if (m->close.count > 0)
    {
        return 1;
    }
    m->most = HUGE_VAL;
    while (m->far.count > 0 && m->far.pair[0].apart.least <= m->most)
    {
        const neighbours pair = pop(m, &m->far);
        if (!is_over(m, &pair))
        {
            m->most = fmin(m->most, pair.apart.most);
            push(m, &m->close, pair);
        }
    }
    return m->close.count > 0;
}

/* Both in one order; of stamps that are equal a's is first. */
static void merge(match *m, const cm_trajectory *a, const cm_trajectory *b)
{
    size_t i = 0;
    size_t j = 0;
    for (size_t k = 0; k < m->count; k++)
    {
        const int is_b = i == a->count || (j < b->count && b->stamp[j] < a->stamp[i]);
        const size_t index = is_b ? j++ : i++;
        m->all[k] = (member){.stamp = is_b ? b->stamp[index] : a->stamp[index],
                             .index = index,
                             .is_b = is_b,
                             .before = k == 0 ? NONE : k - 1,
                             .after = k + 1 == m->count ? NONE : k + 1};
    }
    for (size_t k = 1; k < m->count; k++)
    {
        offer(m, k - 1, k);
    }
}

/* Returns how many pairs there are. */
static size_t take_pairs(match *m)
{
    size_t count = 0;
    while (has_close(m))
    {
        const neighbours pair = pop(m, &m->close);
        if (is_over(m, &pair))
        {
            continue;
        }
        member *first = &m->all[pair.first];
        member *second = &m->all[pair.second];
        first->is_taken = 1;
        second->is_taken = 1;
        m->partner[index_of(m, &pair, 0)] = index_of(m, &pair, 1);
        count++;
        /* pairs that are still in a heap were neighbours then; the two may have others between them no more */
        if (first->before != NONE)
        {
            m->all[first->before].after = second->after;
        }
        if (second->after != NONE)
        {
            m->all[second->after].before = first->before;
        }
        offer(m, first->before, second->after);
    }
    return count;
}

static void write_pairs(const match *m, size_t count_a, size_t *index_a, size_t *index_b)
{
    size_t at = 0;
    for (size_t i = 0; i < count_a; i++)
    {
        if (m->partner[i] != NONE)
        {
            index_a[at] = i;
            index_b[at++] = m->partner[i];
        }
    }
}

cm_status cm_trajectory_associate(const cm_trajectory *a, const cm_trajectory *b, double apart,
                                  size_t room, size_t *index_a, size_t *index_b, size_t *count)
{
    if (a == NULL || b == NULL || count == NULL ||
        (room > 0 && (index_a == NULL || index_b == NULL)))
    {
        return CM_ERROR_ARGUMENT;
    }
    if (!(apart >= 0.0))
    {
        return CM_ERROR_RANGE;
    }
    match m = {.count = a->count + b->count, .apart = apart, .most = -1.0};
    m.all = calloc(m.count, sizeof *m.all);
    /* neither heap ever has more pairs than there are neighbours: what is offered takes the place of what was taken */
    neighbours *const pairs = calloc(m.count, 2 * sizeof *pairs);
    m.far = (heap){is_closer, pairs, 0};
    m.close = (heap){is_earlier, pairs == NULL ? NULL : pairs + m.count, 0};
    m.partner = calloc(a->count, sizeof *m.partner);
    cm_status status = CM_ERROR_MEMORY;
    if (m.all != NULL && pairs != NULL && m.partner != NULL)
    {
        for (size_t i = 0; i < a->count; i++)
        {
            m.partner[i] = NONE;
        }
        merge(&m, a, b);
        *count = take_pairs(&m);
        status = *count <= room ? CM_OK : CM_ERROR_SPACE;
        if (status == CM_OK)
        {
            write_pairs(&m, a->count, index_a, index_b);
        }
    }
    free(m.all);
    free(pairs);
    free(m.partner);
    return status;
}
